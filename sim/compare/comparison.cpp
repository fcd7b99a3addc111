// SPDX-License-Identifier: Apache-2.0
#include "sim/compare/comparison.hpp"
#include "config/ratio.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace degs::sim {
namespace {

std::optional<double> quotient(const std::optional<double>& part,
                               const std::optional<double>& whole) {
    if (!part || !whole || !(*whole > 0)) {
        return {};
    }
    return *part / *whole;
}

Measures measures_of(const ComparedRun& run) {
    Measures measures = run.frame.measures;
    measures[Measure::ThroughputFps].reset(); // a frame alone has none
    if (run.path) {
        measures[Measure::ThroughputFps] = run.path->measures[Measure::ThroughputFps];
    }
    return measures;
}

bool same_view(const ComparedView& a, const ComparedView& b) {
    return a.source == b.source && a.camera == b.camera && a.width == b.width &&
           a.height == b.height;
}

/// Position in the list, to which the view is added if it is new.
std::size_t find_view(std::vector<ComparedView>& views, const ComparedView& view) {
    const auto found = std::find_if(views.begin(), views.end(), [&view](const ComparedView& known) {
        return same_view(known, view);
    });
    const std::size_t position = found - views.begin();
    if (found == views.end()) {
        views.push_back(view);
    }
    return position;
}

void read_config(const RunSummary& run, ComparedConfig& config) {
    config.accelerator = run.accelerator;
    config.pes = run.pes;
    config.tile_size = run.tile_size;
    config.area_mm2 = run.measures[Measure::AreaMm2];
}

void add_ratios(const Measures& first, Measures& measures) {
    measures[Measure::LatencyRatio] =
        quotient(first[Measure::LatencyMs], measures[Measure::LatencyMs]);
    measures[Measure::ThroughputRatio] =
        quotient(measures[Measure::ThroughputFps], first[Measure::ThroughputFps]);
    const auto area = quotient(first[Measure::AreaMm2], measures[Measure::AreaMm2]);
    for (const auto& [ratio, per_area] :
         {std::pair(Measure::LatencyRatio, Measure::LatencyRatioPerArea),
          std::pair(Measure::ThroughputRatio, Measure::ThroughputRatioPerArea)}) {
        if (measures[ratio] && area) {
            measures[per_area] = *measures[ratio] * *area;
        }
    }
}

/// Compares the rows of every view with its row of the first configuration.
void add_ratios(std::vector<ComparisonRow>& rows) {
    for (ComparisonRow& row : rows) {
        const auto first =
            std::find_if(rows.begin(), rows.end(), [&row](const ComparisonRow& other) {
                return other.config == 0 && other.view == row.view;
            });
        if (first != rows.end()) {
            add_ratios(Measures(first->measures), row.measures);
        }
    }
}

/// Over the rows of a configuration; empty unless each of the `views` has a positive number.
std::optional<double> geometric_mean(const std::vector<ComparisonRow>& rows, std::size_t config,
                                     std::size_t views, Measure measure) {
    double sum = 0;
    std::size_t count = 0;
    for (const ComparisonRow& row : rows) {
        const std::optional<double>& value = row.measures[measure];
        if (row.config == config && value && *value > 0) {
            sum += std::log(*value);
            ++count;
        }
    }
    return count == views ? std::optional<double>(std::exp(mean_of(sum, views))) : std::nullopt;
}

std::vector<ComparisonRow> means_of(const Comparison& comparison) {
    std::vector<ComparisonRow> means;
    for (std::size_t c = 0; c < comparison.configs.size(); ++c) {
        ComparisonRow mean;
        mean.config = c;
        mean.view = comparison.views.size(); // none of them
        for_each_measure([&](Measure m) {
            if (has_mean(m)) {
                mean.measures[m] = geometric_mean(comparison.rows, c, comparison.views.size(), m);
            }
        });
        means.push_back(mean);
    }
    return means;
}

} // namespace

Comparison compare(const std::vector<std::string>& configs, const std::vector<ComparedRun>& runs) {
    Comparison comparison;
    for (const std::string& name : configs) {
        ComparedConfig config;
        config.name = name;
        comparison.configs.push_back(config);
    }
    for (const ComparedRun& run : runs) {
        ComparisonRow row;
        row.config = std::find(configs.begin(), configs.end(), run.config) - configs.begin();
        if (row.config == configs.size()) {
            throw std::logic_error("a run of '" + run.config + "' is none of the comparison");
        }
        row.view = find_view(comparison.views, run.frame.view);
        row.measures = measures_of(run);
        read_config(run.frame, comparison.configs[row.config]);
        comparison.rows.push_back(row);
    }
    add_ratios(comparison.rows);
    if (comparison.views.size() > 1) {
        comparison.means = means_of(comparison);
    }
    return comparison;
}

std::string view_words(const ComparedView& view) {
    return view.scene + " · camera " + std::to_string(view.camera) + " · " +
           std::to_string(view.width) + "×" + std::to_string(view.height);
}

std::string family_of(const ComparedConfig& config) {
    if (!config.pes) {
        return config.name;
    }
    const std::string pes = std::to_string(*config.pes);
    std::string family = config.name;
    for (const std::string& token : {"-" + pes, "_" + pes}) {
        const std::size_t at = family.find(token);
        const std::size_t end = at + token.size();
        if (at != std::string::npos && at != 0 &&
            (end == family.size() || family[end] == token.front())) {
            return family.erase(at, token.size());
        }
    }
    return family;
}

} // namespace degs::sim
