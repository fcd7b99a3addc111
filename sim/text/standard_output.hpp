// SPDX-License-Identifier: Apache-2.0
// The only place that writes to stdout.
#pragma once

#include <string>

namespace degs::sim {

/// Writes `text` to stdout and makes sure that it has arrived. Control characters other than
/// newlines are escaped (config/visible_text.hpp), and our own symbols are written in ASCII where
/// the locale has no UTF-8. Throws FailureError with the system's reason, such as a full device.
void print(const std::string& text);

} // namespace degs::sim
