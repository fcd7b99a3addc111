// SPDX-License-Identifier: Apache-2.0
// JSON from text and back. The library is templates, which every source that calls it compiles
// anew; these functions are compiled once.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace degs {

/// On one line, or with `indent` spaces per level if it is not negative. Bytes that are not UTF-8
/// become U+FFFD; with `in_ascii`, other characters are escaped.
std::string dump_json(const nlohmann::json& value, int indent = -1, bool in_ascii = false);
std::string dump_json(const nlohmann::ordered_json& value, int indent = -1, bool in_ascii = false);

/// `discarded` if the text is not JSON.
nlohmann::json parse_json(const std::string& text);
nlohmann::ordered_json parse_ordered_json(const std::string& text);

} // namespace degs
