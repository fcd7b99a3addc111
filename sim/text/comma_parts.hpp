// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace degs::sim {

/// The parts of a text between commas; those within parentheses, brackets or braces belong to a
/// part. At least one, which may be empty.
inline std::vector<std::string> comma_parts(const std::string& text) {
    const std::string open = "([{";
    const std::string close = ")]}";
    std::vector<std::string> parts{""};
    int depth = 0;
    for (const char c : text) {
        depth += open.find(c) != std::string::npos    ? 1
                 : close.find(c) != std::string::npos ? -1
                                                      : 0;
        if (c == ',' && depth <= 0) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

} // namespace degs::sim
