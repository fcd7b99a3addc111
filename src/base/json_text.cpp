// SPDX-License-Identifier: Apache-2.0
#include "base/json_text.hpp"

#include <nlohmann/json.hpp>

namespace degs {

std::string dump_json(const nlohmann::json& value, int indent, bool in_ascii) {
    return value.dump(indent, ' ', in_ascii, nlohmann::json::error_handler_t::replace);
}

std::string dump_json(const nlohmann::ordered_json& value, int indent, bool in_ascii) {
    return value.dump(indent, ' ', in_ascii, nlohmann::ordered_json::error_handler_t::replace);
}

nlohmann::json parse_json(const std::string& text) {
    return nlohmann::json::parse(text, nullptr, false);
}

nlohmann::ordered_json parse_ordered_json(const std::string& text) {
    return nlohmann::ordered_json::parse(text, nullptr, false);
}

} // namespace degs
