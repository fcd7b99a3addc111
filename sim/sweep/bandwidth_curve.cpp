// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/bandwidth_curve.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

namespace degs::sim {
namespace {

/// Rows of a design on a view that differ in the bandwidth of their memory alone.
struct MemoryLine {
    std::size_t view = 0;
    std::string label, memory;
    std::vector<std::size_t> rows; ///< from the least bandwidth to the most, each once
    std::optional<std::size_t> unlimited;
    bool ambiguous = false; ///< two latencies at one bandwidth
};

bool is_of_memory(const std::string& key) {
    return key.rfind("memory.", 0) == 0;
}

/// Positions of the keys along which a line of this model goes; none: the study has no such line.
std::set<std::size_t> bandwidth_keys(const StudyPlan& plan, const std::string& model) {
    const bool bus = model != "lpddr5";
    const std::vector<std::string> ways =
        bus ? std::vector<std::string>{"memory.bandwidth_gb_per_s"}
            : std::vector<std::string>{"memory.lpddr5.channels",
                                       "memory.lpddr5.timing.data_rate_mt_per_s",
                                       "memory.lpddr5.include"};
    for (const std::string& way : ways) {
        const auto found = std::find(plan.keys.begin(), plan.keys.end(), way);
        if (found == plan.keys.end()) {
            continue;
        }
        const std::size_t position = found - plan.keys.begin();
        std::set<std::size_t> along{position};
        for (const StudyPlan::LinkedAxis& axis : plan.linked) {
            if (std::find(axis.keys.begin(), axis.keys.end(), position) != axis.keys.end()) {
                std::copy_if(axis.keys.begin(), axis.keys.end(), std::inserter(along, along.end()),
                             [&plan](std::size_t k) { return is_of_memory(plan.keys[k]); });
            }
        }
        return along;
    }
    return {};
}

double bandwidth_of(const ComparisonRow& row) {
    return row.measures[Measure::DramPeak].value_or(0);
}

/// Adds a row with a bandwidth and a latency.
void add_row(const Comparison& comparison, std::size_t r, MemoryLine& line) {
    const auto latency = [&comparison](std::size_t row) {
        return *comparison.rows[row].measures[Measure::LatencyMs];
    };
    const double bandwidth = bandwidth_of(comparison.rows[r]);
    if (bandwidth >= kUnlimitedGbPerS) {
        line.ambiguous |= line.unlimited && latency(*line.unlimited) != latency(r);
        line.unlimited = r;
        return;
    }
    const auto same = std::find_if(line.rows.begin(), line.rows.end(), [&](std::size_t other) {
        return bandwidth_of(comparison.rows[other]) == bandwidth;
    });
    if (same == line.rows.end()) {
        line.rows.push_back(r);
    } else {
        line.ambiguous |= latency(*same) != latency(r);
    }
}

/// Keys that have one value in all lines, which labels need not tell.
std::set<std::size_t> equal_keys(const StudyPlan& plan, const Comparison& comparison,
                                 const std::vector<MemoryLine>& lines) {
    std::set<std::size_t> equal;
    for (std::size_t k = 0; k < plan.keys.size(); ++k) {
        const auto value = [&](const MemoryLine& line) -> const std::string& {
            return plan.variants[comparison.rows[line.rows.front()].config].values[k];
        };
        if (std::all_of(lines.begin(), lines.end(), [&](const MemoryLine& line) {
                return value(line) == value(lines.front());
            })) {
            equal.insert(k);
        }
    }
    return equal;
}

/// In the order of their first rows; lines of one bandwidth are left out.
std::vector<MemoryLine> lines_of(const StudyPlan& plan, const Comparison& comparison) {
    std::vector<MemoryLine> lines;
    std::map<std::tuple<std::size_t, std::string, std::string>, std::size_t> places;
    std::map<std::string, std::set<std::size_t>> keys; // by model
    for (std::size_t r = 0; r < comparison.rows.size(); ++r) {
        const ComparisonRow& row = comparison.rows[r];
        const StudyVariant& variant = plan.variants[row.config];
        const auto [along, is_model] = keys.try_emplace(variant.memory_model);
        if (is_model) {
            along->second = bandwidth_keys(plan, variant.memory_model);
        }
        if (along->second.empty() || bandwidth_of(row) <= 0 || !row.measures[Measure::LatencyMs]) {
            continue;
        }
        const std::string label = text_without(plan, variant, along->second);
        const auto [place, is_new] =
            places.emplace(std::tuple(row.view, label, variant.memory_model), lines.size());
        if (is_new) {
            lines.push_back({row.view, label, variant.memory_name, {}, {}});
        }
        MemoryLine& line = lines[place->second];
        line.memory = line.memory == variant.memory_name ? line.memory : variant.memory_model;
        add_row(comparison, r, line);
    }
    for (MemoryLine& line : lines) {
        std::sort(line.rows.begin(), line.rows.end(), [&](std::size_t a, std::size_t b) {
            return bandwidth_of(comparison.rows[a]) < bandwidth_of(comparison.rows[b]);
        });
    }
    lines.erase(std::remove_if(
                    lines.begin(), lines.end(),
                    [](const MemoryLine& line) { return line.rows.size() < 2 || line.ambiguous; }),
                lines.end());
    return lines;
}

/// Percent that 10 % more bandwidth gain, from the slope between two points of which the one with
/// more bandwidth takes `ratio` of the other's time.
double gain_of(double ratio, const ComparisonRow& before, const ComparisonRow& after) {
    const double slope = std::log(ratio) / std::log(bandwidth_of(after) / bandwidth_of(before));
    return 100 * (std::pow(1.1, -slope) - 1);
}

Elasticity elasticity_between(const ComparisonRow& before, const ComparisonRow& after) {
    const double ratio = *after.measures[Measure::LatencyMs] / *before.measures[Measure::LatencyMs];
    Elasticity elasticity{gain_of(ratio, before, after)};
    if (const auto between = latency_ratio_interval(before, after)) {
        elasticity.low = gain_of(between->second, before, after);
        elasticity.high = gain_of(between->first, before, after);
    }
    return elasticity;
}

std::optional<Elasticity> elasticity_at(const Comparison& comparison, const MemoryLine& line,
                                        std::size_t i) {
    if (i == 0 || i + 1 >= line.rows.size()) {
        return {};
    }
    return elasticity_between(comparison.rows[line.rows[i - 1]], comparison.rows[line.rows[i + 1]]);
}

/// Empty where even the largest bandwidth gains more, or the smallest one no more.
std::optional<double> enough_of(const std::vector<BandwidthPoint>& points) {
    constexpr double kLittle = 1; // percent
    for (std::size_t i = points.size(); i-- > 1;) {
        const std::optional<Elasticity>&here = points[i - 1].elasticity,
              &next = points[i].elasticity;
        if (here && here->gain >= kLittle) {
            if (!next) {
                return {};
            }
            const double part = (here->gain - kLittle) / (here->gain - next->gain);
            return points[i - 1].gb_per_s *
                   std::pow(points[i].gb_per_s / points[i - 1].gb_per_s, part);
        }
    }
    return {};
}

BandwidthPoint point_of(const ComparisonRow& row) {
    BandwidthPoint point;
    point.gb_per_s = bandwidth_of(row);
    point.latency_ms = *row.measures[Measure::LatencyMs];
    const std::optional<double>& cycles = row.measures[Measure::Cycles];
    const auto in_ms = [&](Measure measure) {
        const std::optional<double>& part = row.measures[measure];
        return part && cycles && *part > 0 && *cycles > 0
                   ? std::optional<double>(*part / *cycles * point.latency_ms)
                   : std::nullopt;
    };
    point.preprocessing_ms = in_ms(Measure::PreprocessingCycles);
    point.blending_ms = in_ms(Measure::BlendingCycles);
    return point;
}

} // namespace

std::vector<std::optional<Elasticity>> elasticities(const StudyPlan& plan,
                                                    const Comparison& comparison) {
    const std::vector<MemoryLine> lines = lines_of(plan, comparison);
    std::vector<std::optional<Elasticity>> list(lines.empty() ? 0 : comparison.rows.size());
    for (const MemoryLine& line : lines) {
        for (std::size_t i = 0; i < line.rows.size(); ++i) {
            list[line.rows[i]] = elasticity_at(comparison, line, i);
        }
    }
    return list;
}

std::vector<BandwidthCurve> bandwidth_curves(const StudyPlan& plan, const Comparison& comparison) {
    std::vector<BandwidthCurve> curves;
    const std::vector<MemoryLine> lines = lines_of(plan, comparison);
    const std::set<std::size_t> equal = equal_keys(plan, comparison, lines);
    for (const MemoryLine& line : lines) {
        const StudyVariant& first = plan.variants[comparison.rows[line.rows.front()].config];
        std::set<std::size_t> untold = bandwidth_keys(plan, first.memory_model);
        untold.insert(equal.begin(), equal.end());
        BandwidthCurve curve;
        curve.label = text_without(plan, first, untold);
        curve.memory = line.memory;
        curve.view = line.view;
        for (std::size_t i = 0; i < line.rows.size(); ++i) {
            curve.points.push_back(point_of(comparison.rows[line.rows[i]]));
            curve.points.back().elasticity = elasticity_at(comparison, line, i);
        }
        if (line.unlimited) {
            curve.unlimited_latency_ms =
                comparison.rows[*line.unlimited].measures[Measure::LatencyMs];
        }
        curve.enough_gb_per_s = enough_of(curve.points);
        curves.push_back(std::move(curve));
    }
    return curves;
}

} // namespace degs::sim
