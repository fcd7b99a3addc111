// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/bandwidth_curve.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace degs::sim {
namespace {

/// Rows of a design on a view that differ in their memory alone.
struct MemoryLine {
    std::size_t view = 0;
    std::string label;
    std::vector<std::size_t> rows; ///< from the least bandwidth to the most, each once
    std::optional<std::size_t> unlimited;
};

bool is_of_memory(const std::string& key) {
    return key.rfind("memory.", 0) == 0;
}

std::string label_of(const StudyPlan& plan, const StudyVariant& variant) {
    std::string label = variant.design;
    for (std::size_t k = 0; k < plan.keys.size(); ++k) {
        if (!is_of_memory(plan.keys[k])) {
            label += " " + plan.keys[k] + "=" + variant.values[k];
        }
    }
    return label;
}

double bandwidth_of(const ComparisonRow& row) {
    return row.measures[Measure::DramPeak].value_or(0);
}

/// In the order of their first rows; lines of one bandwidth are left out. Of points of a line with
/// the same bandwidth, the first one counts.
std::vector<MemoryLine> lines_of(const StudyPlan& plan, const Comparison& comparison) {
    std::vector<MemoryLine> lines;
    std::map<std::pair<std::size_t, std::string>, std::size_t> places; // of view and label
    const bool varied = std::any_of(plan.keys.begin(), plan.keys.end(), is_of_memory);
    for (std::size_t r = 0; varied && r < comparison.rows.size(); ++r) {
        const ComparisonRow& row = comparison.rows[r];
        const std::string label = label_of(plan, plan.variants[row.config]);
        const double bandwidth = bandwidth_of(row);
        if (bandwidth <= 0 || !row.measures[Measure::LatencyMs]) {
            continue;
        }
        const auto [place, is_new] = places.emplace(std::pair(row.view, label), lines.size());
        if (is_new) {
            lines.push_back({row.view, label, {}, {}});
        }
        MemoryLine& line = lines[place->second];
        if (bandwidth >= kUnlimitedGbPerS) {
            line.unlimited = r;
        } else if (std::none_of(line.rows.begin(), line.rows.end(), [&](std::size_t other) {
                       return bandwidth_of(comparison.rows[other]) == bandwidth;
                   })) {
            line.rows.push_back(r);
        }
    }
    for (MemoryLine& line : lines) {
        std::sort(line.rows.begin(), line.rows.end(), [&](std::size_t a, std::size_t b) {
            return bandwidth_of(comparison.rows[a]) < bandwidth_of(comparison.rows[b]);
        });
    }
    lines.erase(std::remove_if(lines.begin(), lines.end(),
                               [](const MemoryLine& line) { return line.rows.size() < 2; }),
                lines.end());
    return lines;
}

/// Percent that 10 % more bandwidth gain, from the slope between two points.
double gain_between(const ComparisonRow& before, const ComparisonRow& after) {
    const double slope =
        std::log(*after.measures[Measure::LatencyMs] / *before.measures[Measure::LatencyMs]) /
        std::log(bandwidth_of(after) / bandwidth_of(before));
    return 100 * (std::pow(1.1, -slope) - 1);
}

std::optional<double> elasticity_at(const Comparison& comparison, const MemoryLine& line,
                                    std::size_t i) {
    if (i == 0 || i + 1 >= line.rows.size()) {
        return {};
    }
    return gain_between(comparison.rows[line.rows[i - 1]], comparison.rows[line.rows[i + 1]]);
}

/// Empty where even the largest bandwidth gains more, or the smallest one no more.
std::optional<double> enough_of(const std::vector<BandwidthPoint>& points) {
    constexpr double kLittle = 1; // percent
    for (std::size_t i = points.size(); i-- > 1;) {
        const std::optional<double>&here = points[i - 1].elasticity, &next = points[i].elasticity;
        if (here && *here >= kLittle) {
            if (!next) {
                return {};
            }
            const double part = (*here - kLittle) / (*here - *next);
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

std::vector<std::optional<double>> elasticities(const StudyPlan& plan,
                                                const Comparison& comparison) {
    const std::vector<MemoryLine> lines = lines_of(plan, comparison);
    std::vector<std::optional<double>> list(lines.empty() ? 0 : comparison.rows.size());
    for (const MemoryLine& line : lines) {
        for (std::size_t i = 0; i < line.rows.size(); ++i) {
            list[line.rows[i]] = elasticity_at(comparison, line, i);
        }
    }
    return list;
}

std::vector<BandwidthCurve> bandwidth_curves(const StudyPlan& plan, const Comparison& comparison) {
    std::vector<BandwidthCurve> curves;
    for (const MemoryLine& line : lines_of(plan, comparison)) {
        BandwidthCurve curve;
        curve.label = line.label;
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
