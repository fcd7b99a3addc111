// SPDX-License-Identifier: Apache-2.0
#include "sim/compare/result_words.hpp"

#include <algorithm>
#include <cmath>

namespace degs::sim {

using nlohmann::ordered_json;

ordered_json number_json(const std::optional<double>& value) {
    if (value && std::isinf(*value)) {
        return "inf";
    }
    if (value && *value == std::floor(*value) && std::abs(*value) < 9e15) {
        return static_cast<std::int64_t>(*value);
    }
    return value_or_null(value);
}

void put_measure(ordered_json& run, Measure measure, const std::optional<double>& value) {
    std::string place = "/" + name_of(measure);
    std::replace(place.begin(), place.end(), '.', '/');
    run[ordered_json::json_pointer(place)] = number_json(value);
}

ordered_json view_json(const ComparedView& view) {
    return {{"scene", view.scene},
            {"source", view.source},
            {"camera", view.camera},
            {"img_name", view.camera_name},
            {"width", view.width},
            {"height", view.height},
            {"gaussians", view.gaussians},
            {"visible", view.visible},
            {"fragments", value_or_null(view.fragments)}};
}

std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
        return text;
    }
    std::string cell = "\"";
    for (char c : text) {
        cell += c == '"' ? std::string("\"\"") : std::string(1, c);
    }
    return cell + "\"";
}

std::string csv_number(const std::optional<double>& value) {
    const ordered_json json = number_json(value);
    return json.is_null() ? "" : json.is_string() ? json.get<std::string>() : json.dump();
}

} // namespace degs::sim
