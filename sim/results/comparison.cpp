// SPDX-License-Identifier: Apache-2.0
#include "sim/results/comparison.hpp"
#include "base/ratio.hpp"

#include <algorithm>
#include <cmath>
#include <map>
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

/// With the changes of the frames, which a frame alone does not know.
ComparedView view_of(const ComparedRun& run) {
    ComparedView view = run.frame.view;
    if (run.path) {
        view.changes = run.path->view.changes;
    }
    return view;
}

bool same_view(const ComparedView& a, const ComparedView& b) {
    return a.source == b.source && a.camera == b.camera && a.width == b.width &&
           a.height == b.height;
}

/// Position in the list, to which the view is added if it is new.
std::size_t find_view(std::vector<ComparedView>& views, const ComparedView& view) {
    const auto found = // the last first, because the runs of a view follow one another
        std::find_if(views.rbegin(), views.rend(),
                     [&view](const ComparedView& known) { return same_view(known, view); });
    if (found != views.rend()) {
        return views.rend() - found - 1;
    }
    views.push_back(view);
    return views.size() - 1;
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
    measures[Measure::EnergyRatio] =
        quotient(first[Measure::NjPerFrame], measures[Measure::NjPerFrame]);
    const auto area = quotient(first[Measure::AreaMm2], measures[Measure::AreaMm2]);
    for (const auto& [ratio, per_area] :
         {std::pair(Measure::LatencyRatio, Measure::LatencyRatioPerArea),
          std::pair(Measure::ThroughputRatio, Measure::ThroughputRatioPerArea),
          std::pair(Measure::EnergyRatio, Measure::EnergyRatioPerArea)}) {
        if (measures[ratio] && area) {
            measures[per_area] = *measures[ratio] * *area;
        }
    }
}

/// Compares the rows of every view with its row of the baseline.
void add_ratios(std::vector<ComparisonRow>& rows, std::size_t baseline) {
    std::map<std::size_t, Measures> bases; // by view
    for (const ComparisonRow& row : rows) {
        if (row.config == baseline) {
            bases.emplace(row.view, row.measures);
        }
    }
    for (ComparisonRow& row : rows) {
        const auto base = bases.find(row.view);
        if (base != bases.end()) {
            add_ratios(base->second, row.measures);
        }
    }
}

/// Over the rows of one configuration; empty unless each of the `views` has a positive number.
std::optional<double> geometric_mean(const std::vector<const ComparisonRow*>& rows,
                                     std::size_t views, Measure measure) {
    double sum = 0;
    std::size_t count = 0;
    for (const ComparisonRow* row : rows) {
        const std::optional<double>& value = row->measures[measure];
        if (value && *value > 0) {
            sum += std::log(*value);
            ++count;
        }
    }
    return count == views ? std::optional<double>(std::exp(mean_of(sum, views))) : std::nullopt;
}

std::vector<ComparisonRow> means_of(const Comparison& comparison) {
    std::vector<std::vector<const ComparisonRow*>> rows(comparison.configs.size());
    for (const ComparisonRow& row : comparison.rows) {
        rows[row.config].push_back(&row);
    }
    std::vector<ComparisonRow> means;
    for (std::size_t c = 0; c < comparison.configs.size(); ++c) {
        ComparisonRow mean;
        mean.config = c;
        mean.view = comparison.views.size(); // none of them
        for_each_measure([&](Measure m) {
            if (has_mean(m)) {
                mean.measures[m] = geometric_mean(rows[c], comparison.views.size(), m);
            }
        });
        means.push_back(mean);
    }
    return means;
}

} // namespace

Comparison compare(const std::vector<std::string>& configs, const std::vector<ComparedRun>& runs,
                   std::size_t baseline) {
    Comparison comparison;
    comparison.baseline = baseline;
    std::map<std::string, std::size_t> places;
    for (const std::string& name : configs) {
        places.emplace(name, comparison.configs.size());
        ComparedConfig config;
        config.name = name;
        comparison.configs.push_back(config);
    }
    for (const ComparedRun& run : runs) {
        const auto place = places.find(run.config);
        if (place == places.end()) {
            throw std::logic_error("a run of '" + run.config + "' is none of the comparison");
        }
        ComparisonRow row{run.frame, find_view(comparison.views, view_of(run)), place->second,
                          run.report};
        row.measures = measures_of(run);
        read_config(run.frame, comparison.configs[row.config]);
        comparison.rows.push_back(row);
    }
    add_ratios(comparison.rows, baseline);
    if (comparison.views.size() > 1) {
        comparison.means = means_of(comparison);
    }
    return comparison;
}

std::string view_words(const ComparedView& view) {
    return view.scene + " · camera " + std::to_string(view.camera) + " · " +
           (view.views > 1 ? std::to_string(view.views) + " × " : "") + std::to_string(view.width) +
           "×" + std::to_string(view.height);
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

bool Comparison::is_estimated() const {
    return std::any_of(rows.begin(), rows.end(),
                       [](const ComparisonRow& row) { return row.fidelity == "analytic"; });
}

bool Comparison::has_camera_path() const {
    return frames > 1 && std::any_of(views.begin(), views.end(),
                                     [](const ComparedView& view) { return !view.dynamic; });
}

bool Comparison::has_dynamic_scene() const {
    return std::any_of(views.begin(), views.end(),
                       [](const ComparedView& view) { return view.dynamic; });
}

} // namespace degs::sim
