// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/median.hpp"
#include "base/number_json.hpp"
#include "sim/accuracy/speed/speed.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

bool together(const SpeedRow& row, const SpeedGroup& group) {
    return row.accelerator == group.accelerator && row.fidelity == group.fidelity &&
           row.numbers == group.numbers;
}

std::vector<const SpeedRow*> rows_in(const std::vector<SpeedRow>& rows, const SpeedGroup& group) {
    std::vector<const SpeedRow*> members;
    for (const SpeedRow& row : rows) {
        if (together(row, group)) {
            members.push_back(&row);
        }
    }
    return members;
}

/// Empty if no row has the number.
template <class Number>
std::optional<double> median_of(const std::vector<const SpeedRow*>& rows, const Number& number) {
    std::vector<double> values;
    for (const SpeedRow* row : rows) {
        const std::optional<double> value = number(*row);
        if (value) {
            values.push_back(*value);
        }
    }
    return degs::median_of(std::move(values));
}

/// Cycles of the exact run of the same design in the same numbers; empty if there was none.
std::optional<double> cycles_of_exact(const std::vector<SpeedRow>& rows, const SpeedGroup& group) {
    for (const SpeedRow& row : rows) {
        const bool all_tiles = row.fidelity == "exact" || row.fidelity == "strict";
        if (all_tiles && row.accelerator == group.accelerator && row.numbers == group.numbers) {
            return row.cycles;
        }
    }
    return {};
}

void fill(SpeedGroup& group, const std::vector<SpeedRow>& rows) {
    const std::vector<const SpeedRow*> members = rows_in(rows, group);
    const std::optional<double> exact = cycles_of_exact(rows, group);
    group.runs = members.size();
    for (const SpeedRow* row : members) {
        const bool sampled = row->share.has_value();
        group.sampled += sampled ? 1 : 0;
        group.held += sampled && exact && row->interval_low.value_or(INFINITY) <= *exact &&
                              *exact <= row->interval_high.value_or(-INFINITY)
                          ? 1
                          : 0;
    }
    using Number = std::optional<double>;
    group.over_render =
        *median_of(members, [](const SpeedRow& row) { return Number(row.over_render); });
    group.fragments_per_s =
        *median_of(members, [](const SpeedRow& row) { return Number(row.fragments_per_s); });
    group.cycles_error =
        *median_of(members, [](const SpeedRow& row) { return Number(std::abs(row.cycles_error)); });
    group.utilization_error = *median_of(
        members, [](const SpeedRow& row) { return Number(std::abs(row.utilization_error)); });
    group.dram_error = median_of(members, [](const SpeedRow& row) {
        return row.dram_error ? Number(std::abs(*row.dram_error)) : Number();
    });
    group.identical = members.front()->identical;
    group.psnr_db = members.front()->psnr_db;
}

/// Percent in three digits; a difference of nothing is "0".
std::string percent_words(std::optional<double> error) {
    if (!error) {
        return "";
    }
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", 100 * *error);
    return text;
}

std::string held_words(const SpeedGroup& group) {
    if (group.fidelity == "exact" || group.fidelity == "strict" || group.fidelity == "analytic") {
        return "";
    }
    if (group.sampled == 0) {
        return "exact instead";
    }
    return std::to_string(group.held) + " of " + std::to_string(group.sampled);
}

ordered_json row_json(const SpeedRow& row) {
    ordered_json json;
    json["accelerator"] = row.accelerator;
    json["fidelity"] = row.fidelity;
    json["numbers"] = row.numbers;
    json["seed"] = value_or_null(row.seed);
    json["sim_s"] = row.sim_s;
    json["over_render"] = row.over_render;
    json["fragments_per_s"] = row.fragments_per_s;
    json["cycles"] = row.cycles;
    json["cycles_error"] = row.cycles_error;
    json["utilization_error"] = row.utilization_error;
    json["dram_error"] = value_or_null(row.dram_error);
    json["identical"] = row.identical;
    json["psnr_db"] = value_or_null(row.psnr_db);
    json["share"] = value_or_null(row.share);
    json["interval_low"] = value_or_null(row.interval_low);
    json["interval_high"] = value_or_null(row.interval_high);
    return json;
}

} // namespace

std::vector<SpeedGroup> speed_groups(const std::vector<SpeedRow>& rows) {
    std::vector<SpeedGroup> groups;
    for (const SpeedRow& row : rows) {
        if (groups.empty() || !together(row, groups.back())) {
            SpeedGroup group;
            group.accelerator = row.accelerator;
            group.fidelity = row.fidelity;
            group.numbers = row.numbers;
            fill(group, rows);
            groups.push_back(std::move(group));
        }
    }
    return groups;
}

std::string speed_table(const SpeedResult& result) {
    TextTable table({"accelerator", "numbers", "fidelity", "x render", "fragments/s", "cycles %",
                     "utilization %", "DRAM %", "PSNR dB", "intervals hold"});
    for (const SpeedGroup& group : speed_groups(result.rows)) {
        table.add(
            {group.accelerator, group.numbers, group.fidelity, three_digits(group.over_render),
             scaled(group.fragments_per_s), percent_words(group.cycles_error),
             percent_words(group.utilization_error), percent_words(group.dram_error),
             group.identical ? "identical" : (group.psnr_db ? three_digits(*group.psnr_db) : ""),
             held_words(group)});
    }
    return table.text();
}

ordered_json speed_json(const SpeedResult& result) {
    ordered_json json;
    json["view"] = {{"scene", result.view.scene},
                    {"camera", result.view.camera},
                    {"width", result.view.width},
                    {"height", result.view.height},
                    {"fragments", result.view.fragments}};
    json["compared_with"] = {{"fidelity", "strict"}, {"numbers", "ideal"}};
    json["rows"] = ordered_json::array();
    for (const SpeedRow& row : result.rows) {
        json["rows"].push_back(row_json(row));
    }
    json["intervals"] = ordered_json::array();
    for (const SpeedGroup& group : speed_groups(result.rows)) {
        if (!held_words(group).empty()) {
            json["intervals"].push_back({{"accelerator", group.accelerator},
                                         {"fidelity", group.fidelity},
                                         {"numbers", group.numbers},
                                         {"runs", group.runs},
                                         {"sampled", group.sampled},
                                         {"held", group.held}});
        }
    }
    return json;
}

} // namespace degs::sim
