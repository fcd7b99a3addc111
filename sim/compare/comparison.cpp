// SPDX-License-Identifier: Apache-2.0
#include "sim/compare/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/plot/plot_svg.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;
using Pointer = ordered_json::json_pointer;

/// How a measure comes from reports and whether its geometric mean says something.
struct MeasureRule {
    const char* place;
    const char* source; ///< in the report of one frame; null: derived
    bool mean;
};

constexpr std::array<MeasureRule, static_cast<std::size_t>(Measure::Count)> kRules{{
    {"/cycles", "/timing/cycles", false},
    {"/latency_ms", "/timing/latency_ms", true},
    {"/fps", "/timing/fps", true},
    {"/throughput_fps", nullptr, true},
    {"/slots/useful", nullptr, false},
    {"/slots/boundary", nullptr, false},
    {"/slots/terminated", nullptr, false},
    {"/slots/conflict", nullptr, false},
    {"/slots/starved", nullptr, false},
    {"/slots/blocked", nullptr, false},
    {"/slots/drain", nullptr, false},
    {"/slots/utilization", "/slots/utilization", true},
    {"/slots/frame_utilization", "/slots/frame_utilization", true},
    {"/dram/bytes_read", "/dram/bytes_read", false},
    {"/dram/bytes_written", "/dram/bytes_written", false},
    {"/dram/utilization", "/dram/utilization", false},
    {"/area_mm2", "/area/mm2", false},
    {"/ratio/latency", nullptr, true},
    {"/ratio/throughput", nullptr, true},
    {"/ratio/latency_per_mm2", nullptr, true},
    {"/ratio/throughput_per_mm2", nullptr, true},
    {"/image/psnr_db", "/image/psnr_db", false},
    {"/image/ssim", "/image/ssim", false},
    {"/image/max_abs_error", "/image/max_abs_error", false},
    {"/host/sim_s", "/host/sim_s", false},
}};

/// Empty for what is missing or null.
std::optional<double> number_at(const ordered_json& report, const char* place) {
    const Pointer pointer(place);
    if (!report.contains(pointer)) {
        return {};
    }
    const ordered_json& value = report[pointer];
    if (value.is_string() && value == "inf") {
        return std::numeric_limits<double>::infinity();
    }
    return value.is_number() ? std::optional<double>(value.get<double>()) : std::nullopt;
}

std::string text_at(const ordered_json& report, const char* place) {
    return report.value(Pointer(place), std::string());
}

std::optional<double> quotient(const std::optional<double>& part,
                               const std::optional<double>& whole) {
    if (!part || !whole || !(*whole > 0)) {
        return {};
    }
    return *part / *whole;
}

void read_slots(const ordered_json& report, Measures& measures) {
    const std::optional<double> total = number_at(report, "/slots/total");
    for (std::size_t c = 0; c < kSlotClasses.size(); ++c) {
        const std::string place = std::string("/slots/") + kSlotClasses[c].name;
        measures[static_cast<Measure>(static_cast<std::size_t>(Measure::Useful) + c)] =
            quotient(number_at(report, place.c_str()), total);
    }
}

Measures measures_of(const ComparedRun& run) {
    Measures measures;
    for (std::size_t m = 0; m < kRules.size(); ++m) {
        if (kRules[m].source != nullptr) {
            measures[static_cast<Measure>(m)] = number_at(run.frame, kRules[m].source);
        }
    }
    read_slots(run.frame, measures);
    measures[Measure::ThroughputFps] = number_at(run.path, "/timing/throughput_fps");
    if (!number_at(run.frame, "/dram/peak_gb_per_s")) { // memory without limit: nothing is counted
        for (Measure m : {Measure::DramRead, Measure::DramWritten, Measure::DramUtilization}) {
            measures[m].reset();
        }
    }
    return measures;
}

ComparedView view_of(const ComparedRun& run) {
    const ordered_json& report = run.frame;
    ComparedView view;
    view.scene = text_at(report, "/scene/name");
    view.source = text_at(report, "/scene/source");
    view.camera = run.camera;
    view.camera_name = text_at(report, "/camera/img_name");
    view.width = report.value(Pointer("/camera/width"), 0);
    view.height = report.value(Pointer("/camera/height"), 0);
    view.gaussians = report.value(Pointer("/workload/gaussians"), std::size_t{0});
    view.visible = report.value(Pointer("/workload/visible"), std::size_t{0});
    if (const auto fragments = number_at(report, "/workload/fragments")) {
        view.fragments = static_cast<std::size_t>(*fragments);
    }
    return view;
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
    const auto position = static_cast<std::size_t>(found - views.begin());
    if (found == views.end()) {
        views.push_back(view);
    }
    return position;
}

void read_config(const ordered_json& report, ComparedConfig& config) {
    config.accelerator = text_at(report, "/config/accelerator");
    config.pes = report.value(Pointer("/slots/pes"), 0);
    config.tile_size = report.value(Pointer("/workload/tile_size"), 0);
    config.area_mm2 = number_at(report, "/area/mm2");
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
    return count == views ? std::optional<double>(std::exp(sum / static_cast<double>(views)))
                          : std::nullopt;
}

std::vector<ComparisonRow> means_of(const Comparison& comparison) {
    std::vector<ComparisonRow> means;
    for (std::size_t c = 0; c < comparison.configs.size(); ++c) {
        ComparisonRow mean;
        mean.config = c;
        mean.view = comparison.views.size(); // none of them
        for (std::size_t m = 0; m < kRules.size(); ++m) {
            if (kRules[m].mean) {
                mean.measures[static_cast<Measure>(m)] = geometric_mean(
                    comparison.rows, c, comparison.views.size(), static_cast<Measure>(m));
            }
        }
        means.push_back(mean);
    }
    return means;
}

} // namespace

const char* place_of(Measure measure) {
    return kRules[static_cast<std::size_t>(measure)].place;
}

Comparison compare(const std::vector<std::string>& configs, const std::vector<ComparedRun>& runs) {
    Comparison comparison;
    for (const std::string& name : configs) {
        ComparedConfig config;
        config.name = name;
        comparison.configs.push_back(config);
    }
    for (const ComparedRun& run : runs) {
        ComparisonRow row;
        row.config = static_cast<std::size_t>(
            std::find(configs.begin(), configs.end(), run.config) - configs.begin());
        if (row.config == configs.size()) {
            throw std::logic_error("a run of '" + run.config + "' is none of the comparison");
        }
        row.view = find_view(comparison.views, view_of(run));
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
