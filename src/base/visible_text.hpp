// SPDX-License-Identifier: Apache-2.0
// Names out of files, as a terminal may see them.
#pragma once

#include <string>

namespace degs {

/// `text` (UTF-8) with every byte escaped that could control a terminal or break a line: control
/// characters (U+0000 to U+001F, U+007F to U+009F), line and paragraph separators, marks that
/// reverse the direction of text, and bytes that are no UTF-8. "a\nb" becomes "a\\nb", others
/// "\\x1b", one "\\x.." per byte.
std::string visible(const std::string& text);

/// `text` of several lines, escaped as visible() does, but newlines stay.
std::string visible_lines(const std::string& text);

} // namespace degs
