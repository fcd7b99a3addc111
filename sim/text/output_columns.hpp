// SPDX-License-Identifier: Apache-2.0
// Lines no longer than the terminal, and characters that it can show.
#pragma once

#include <cstddef>
#include <string>

namespace degs::sim {

/// Characters per line on the standard output: what the environment variable COLUMNS says, else the
/// width of the terminal. Without both there is no limit, because a program reads the lines.
std::size_t output_columns();

/// `text`, which may have several lines, with line feeds where a line would become longer than
/// `width`; what follows a break is indented by `indent`. Lines break at " · " and wide gaps, else
/// between words, but never within a number or between a number and its unit. A word that is
/// too long stays whole.
std::string folded(const std::string& text, std::size_t width, std::size_t indent = 0);

/// False if LC_ALL, LC_CTYPE or LANG, the first of them that is set, names a locale without UTF-8.
bool shows_utf8();
/// The program's own symbols in ASCII: "×" as "x", "·" as "-", "mm²" as "mm2".
std::string in_ascii(const std::string& text);

} // namespace degs::sim
