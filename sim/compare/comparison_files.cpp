// SPDX-License-Identifier: Apache-2.0
// compare.json and compare.csv, both from the table of measures.
#include <nlohmann/json.hpp>

#include "base/number_json.hpp"
#include "sim/compare/comparison_output.hpp"
#include "sim/report/report.hpp"
#include "sim/results/result_words.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

ordered_json row_json(const Comparison& comparison, const ComparisonRow& row) {
    ordered_json json = {{"config", comparison.configs[row.config].name}};
    if (row.view < comparison.views.size()) {
        json["view"] = row.view;
    }
    if (!row.fidelity.empty()) { // a mean has none
        json["fidelity"] = row.fidelity;
    }
    for_each_measure([&](Measure m) { put_measure(json, m, row.measures[m]); });
    put_parts(json, row);
    put_interval(json, row);
    return json;
}

ordered_json config_json(const ComparedConfig& config) {
    return {{"name", config.name},
            {"accelerator",
             config.accelerator.empty() ? ordered_json() : ordered_json(config.accelerator)},
            {"pes", value_or_null(config.pes)},
            {"tile_size", value_or_null(config.tile_size)},
            {"area_mm2", value_or_null(config.area_mm2)}};
}

} // namespace

ordered_json comparison_json(const Comparison& comparison) {
    ordered_json json;
    json["schema"] = {{"name", "degs-compare"}, {"version", kComparisonVersion}};
    json["tool"] = tool_json();
    json["frames"] = comparison.frames;
    json["path_step_degrees"] =
        comparison.has_camera_path() ? ordered_json(comparison.path_step_degrees) : ordered_json();
    json["array_only"] = comparison.array_only;
    for (const char* list : {"configs", "views", "runs", "means", "failed"}) {
        json[list] = ordered_json::array();
    }
    for (const ComparedConfig& config : comparison.configs) {
        json["configs"].push_back(config_json(config));
    }
    for (const ComparedView& view : comparison.views) {
        json["views"].push_back(view_json(view));
    }
    for (const ComparisonRow& row : comparison.rows) {
        json["runs"].push_back(row_json(comparison, row));
    }
    for (const ComparisonRow& mean : comparison.means) {
        json["means"].push_back(row_json(comparison, mean));
    }
    for (const FailedRun& failed : comparison.failed) {
        json["failed"].push_back(
            {{"config", failed.config}, {"view", failed.view}, {"why", failed.sentence}});
    }
    return json;
}

std::string comparison_csv(const Comparison& comparison) {
    std::string text = "config" + run_headings();
    for_each_measure([&](Measure m) { text += "," + name_of(m); });
    const bool intervals = any_interval(comparison.rows);
    const std::vector<std::string> parts = names_of(comparison.rows, &RunNumbers::parts);
    text += part_headings(parts) + (intervals ? interval_headings() : "") + "\n";
    for (const ComparisonRow& row : comparison.rows) {
        text += csv_cell(comparison.configs[row.config].name) + run_cells(comparison, row);
        for_each_measure([&](Measure m) { text += "," + csv_number(row.measures[m]); });
        text += named_cells(row, &RunNumbers::parts, parts) +
                (intervals ? interval_cells(row) : "") + "\n";
    }
    return text;
}

} // namespace degs::sim
