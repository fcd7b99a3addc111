// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include "sim/compare/comparison_output.hpp"
#include "sim/plot/plot_svg.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

SlotBar bar_of(const Comparison& comparison, const ComparisonRow& row) {
    const ComparedConfig& config = comparison.configs[row.config];
    SlotBar bar;
    bar.label = config.name;
    bar.note = std::to_string(config.pes.value_or(0)) + " PEs";
    if (row.measures[Measure::Fps]) {
        bar.note += " · " + three_digits(*row.measures[Measure::Fps]) + " fps";
    }
    bar.note += row.limited_by.empty() ? "" : " · limit: " + row.limited_by;
    bar.end_ms = row.measures[Measure::LatencyMs].value_or(0);
    bar.first_ms = row.first_task_ms.value_or(0);
    bar.last_ms = row.last_task_ms.value_or(bar.end_ms);
    bar.end_ms = std::max(bar.end_ms, bar.last_ms);
    for (std::size_t c = 0; c < bar.shares.size(); ++c) {
        bar.shares[c] = row.measures[slot_measure(kSlotClasses[c].slot)].value_or(0);
    }
    return bar;
}

/// In the order of the configurations.
std::vector<std::string> families_of(const Comparison& comparison) {
    std::vector<std::string> families;
    for (const ComparedConfig& config : comparison.configs) {
        const std::string family = family_of(config);
        if (config.pes && std::find(families.begin(), families.end(), family) == families.end()) {
            families.push_back(family);
        }
    }
    return families;
}

UtilizationLine line_of(const Comparison& comparison, std::size_t view, const std::string& family) {
    UtilizationLine line;
    line.label = family;
    for (const ComparisonRow& row : comparison.rows) {
        const ComparedConfig& config = comparison.configs[row.config];
        if (row.view == view && family_of(config) == family && row.measures[Measure::Utilization]) {
            line.points.emplace_back(*config.pes, *row.measures[Measure::Utilization]);
        }
    }
    return line;
}

bool has_several_pe_counts(const Comparison& comparison) {
    std::set<int> counts;
    for (const ComparisonRow& row : comparison.rows) {
        if (row.measures[Measure::Utilization]) {
            counts.insert(*comparison.configs[row.config].pes);
        }
    }
    return counts.size() > 1;
}

std::string with_note(const Comparison& comparison, const std::string& title) {
    return title + (comparison.is_estimated() ? " (estimated)"
                    : comparison.array_only   ? " (arrays alone)"
                                              : "");
}

/// A measure of ratios.svg.
struct ShownRatio {
    Measure own, equal_area;
    const char* words;
};

constexpr ShownRatio kShownRatios[] = {
    {Measure::LatencyRatio, Measure::LatencyRatioPerArea, "latency of the first / latency"},
    {Measure::ThroughputRatio, Measure::ThroughputRatioPerArea,
     "throughput / throughput of the first"},
    {Measure::EnergyRatio, Measure::EnergyRatioPerArea,
     "energy per frame of the first / energy per frame"}};

/// By configuration, from the rows of a view or from the means.
RatioGroup ratio_group(const Comparison& comparison, const std::vector<ComparisonRow>& rows,
                       std::size_t view, Measure measure) {
    const bool mean = view == comparison.views.size();
    RatioGroup group;
    group.label = mean ? "geometric mean" : view_words(comparison.views[view]);
    group.ratios.resize(comparison.configs.size());
    for (const ComparisonRow& row : rows) {
        if (row.view == view) {
            group.ratios[row.config] = row.measures[measure];
        }
    }
    return group;
}

bool has_ratio(const RatioPanel& panel) {
    for (const RatioGroup& group : panel.groups) {
        for (const std::optional<double>& ratio : group.ratios) {
            if (ratio) {
                return true;
            }
        }
    }
    return false;
}

RatioPanel ratio_panel(const Comparison& comparison, const ShownRatio& shown, AreaScale scale) {
    const bool equal = scale == AreaScale::Equal;
    const Measure measure = equal ? shown.equal_area : shown.own;
    RatioPanel panel;
    panel.heading = std::string(shown.words) + (equal ? ", × area of the first / area" : "");
    for (std::size_t v = 0; v < comparison.views.size(); ++v) {
        panel.groups.push_back(ratio_group(comparison, comparison.rows, v, measure));
    }
    if (!comparison.means.empty()) {
        panel.groups.push_back(
            ratio_group(comparison, comparison.means, comparison.views.size(), measure));
    }
    return panel;
}

} // namespace

std::string ratios_picture(const Comparison& comparison, AreaScale scale) {
    if (comparison.configs.size() < 2) {
        return "";
    }
    std::vector<RatioPanel> panels;
    for (const ShownRatio& shown : kShownRatios) {
        RatioPanel panel = ratio_panel(comparison, shown, scale);
        if (has_ratio(panel)) { // a frame alone has no throughput, and an estimate no energy
            panels.push_back(std::move(panel));
        }
    }
    std::vector<std::string> names;
    for (const ComparedConfig& config : comparison.configs) {
        names.push_back(config.name);
    }
    const std::string& first = names[comparison.baseline];
    const std::string title = scale == AreaScale::Equal ? "At the area of " + first + ", which is 1"
                                                        : "Against " + first + ", which is 1";
    return panels.empty() ? "" : ratios_svg(with_note(comparison, title), names, panels);
}

std::string slots_picture(const Comparison& comparison) {
    std::vector<SlotGroup> groups;
    for (std::size_t v = 0; v < comparison.views.size(); ++v) {
        SlotGroup group;
        group.heading = view_words(comparison.views[v]);
        for (const ComparisonRow& row : comparison.rows) {
            if (row.view == v && row.measures[slot_measure(Slot::Useful)]) {
                group.bars.push_back(bar_of(comparison, row));
            }
        }
        if (!group.bars.empty()) {
            groups.push_back(std::move(group));
        }
    }
    return groups.empty() ? ""
                          : slots_svg(with_note(comparison, "Where the PE-cycles went"), groups);
}

std::string utilization_picture(const Comparison& comparison) {
    if (!has_several_pe_counts(comparison)) {
        return "";
    }
    std::vector<UtilizationPanel> panels;
    for (std::size_t v = 0; v < comparison.views.size(); ++v) {
        UtilizationPanel panel;
        panel.heading = view_words(comparison.views[v]);
        for (const std::string& family : families_of(comparison)) {
            panel.lines.push_back(line_of(comparison, v, family));
        }
        panels.push_back(std::move(panel));
    }
    return utilization_svg(with_note(comparison, "PE utilization as the array grows"), panels);
}

} // namespace degs::sim
