// SPDX-License-Identifier: Apache-2.0
#include "sim/results/result_words.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "base/json_text.hpp"
#include "base/number_json.hpp"
#include "base/visible_text.hpp"
#include "sim/report/report.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {

using nlohmann::ordered_json;

ordered_json number_json(const std::optional<double>& value) {
    if (value && *value == std::floor(*value) && std::abs(*value) < 9e15) {
        return static_cast<std::int64_t>(*value);
    }
    return value ? degs::number_json(*value) : ordered_json();
}

namespace {

void put_number(ordered_json& run, const std::string& name, const std::optional<double>& value) {
    std::string place = "/" + name;
    std::replace(place.begin(), place.end(), '.', '/');
    run[ordered_json::json_pointer(place)] = number_json(value);
}

} // namespace

void put_measure(ordered_json& run, Measure measure, const std::optional<double>& value) {
    put_number(run, name_of(measure), value);
}

void put_parts(ordered_json& run, const ComparisonRow& row) {
    for (const auto& [name, value] : row.parts) {
        put_number(run, name, value);
    }
}

std::vector<std::string> names_of(const std::vector<ComparisonRow>& rows,
                                  NamedNumbers RunNumbers::*list) {
    std::vector<std::string> names;
    for (const ComparisonRow& row : rows) {
        for (const auto& [name, value] : row.*list) {
            if (std::find(names.begin(), names.end(), name) == names.end()) {
                names.push_back(name);
            }
        }
    }
    return names;
}

std::string part_headings(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) {
        text += "," + csv_cell(name);
    }
    return text;
}

std::string named_cells(const ComparisonRow& row, NamedNumbers RunNumbers::*list,
                        const std::vector<std::string>& names) {
    const NamedNumbers& numbers = row.*list;
    std::string text;
    for (const std::string& name : names) {
        const auto found = std::find_if(numbers.begin(), numbers.end(),
                                        [&name](const auto& each) { return each.first == name; });
        text += "," + (found == numbers.end() ? "" : csv_number(found->second));
    }
    return text;
}

std::string run_headings() {
    return ",accelerator,pes,tile_size,scene,camera,width,height,fidelity";
}

std::string run_cells(const Comparison& comparison, const ComparisonRow& row) {
    const ComparedConfig& config = comparison.configs[row.config];
    const ComparedView& view = comparison.views[row.view];
    return "," + csv_cell(config.accelerator) + "," + std::to_string(config.pes.value_or(0)) + "," +
           std::to_string(config.tile_size.value_or(0)) + "," + csv_cell(view.scene) + "," +
           std::to_string(view.camera) + "," + std::to_string(view.width) + "," +
           std::to_string(view.height) + "," + csv_cell(row.fidelity);
}

ordered_json view_json(const ComparedView& view) {
    ordered_json json = {{"scene", view.scene},
                         {"source", view.source},
                         {"camera", view.camera},
                         {"img_name", view.camera_name},
                         {"width", view.width},
                         {"height", view.height},
                         {"gaussians", view.gaussians},
                         {"visible", view.visible},
                         {"fragments", value_or_null(view.fragments)}};
    if (view.views > 1) {
        json["views_per_frame"] = view.views;
    }
    if (view.changes) {
        json["changes"] = changes_json(*view.changes);
    }
    return json;
}

namespace {

/// Tables begin to calculate at these characters, of which a number may have a sign.
bool is_formula(const std::string& text) {
    if (text.empty() || std::string_view("=+-@").find(text.front()) == std::string_view::npos) {
        return false;
    }
    double number = 0;
    const char* const begin = text.data() + (text.front() == '+' ? 1 : 0);
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(begin, end, number);
    return error == std::errc::invalid_argument || rest != end;
}

/// As tables and terminals may see it. Line ends of both kinds stay: quotes are for them.
std::string harmless(const std::string& text) {
    std::string shown = is_formula(text) ? "'" : "";
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find("\r\n", at), text.size());
        shown += visible_lines(text.substr(at, end - at)) + (end < text.size() ? "\r\n" : "");
        at = end + 2;
    }
    return shown;
}

} // namespace

std::string csv_cell(const std::string& text) {
    std::string shown = harmless(text);
    if (shown.find_first_of(",\"\n") == std::string::npos) {
        return shown;
    }
    std::string cell = "\"";
    for (char c : shown) {
        cell += c == '"' ? std::string("\"\"") : std::string(1, c);
    }
    return cell + "\"";
}

std::string csv_number(const std::optional<double>& value) {
    const ordered_json json = number_json(value);
    return json.is_null()             ? ""
           : json.is_string()         ? json.get<std::string>()
           : json.is_number_integer() ? dump_json(json)
                                      : decimal_of(*value);
}

void put_interval(nlohmann::ordered_json& run, const ComparisonRow& row) {
    if (row.cycles_low) {
        run["interval"] = {{"sampled", number_json(row.sampled_share)},
                           {"cycles", {number_json(row.cycles_low), number_json(row.cycles_high)}}};
    }
}

bool any_interval(const std::vector<ComparisonRow>& rows) {
    return std::any_of(rows.begin(), rows.end(),
                       [](const ComparisonRow& row) { return row.cycles_low.has_value(); });
}

std::string interval_headings() {
    return ",interval.sampled,interval.cycles_low,interval.cycles_high";
}

std::string interval_cells(const ComparisonRow& row) {
    return "," + csv_number(row.sampled_share) + "," + csv_number(row.cycles_low) + "," +
           csv_number(row.cycles_high);
}

} // namespace degs::sim
