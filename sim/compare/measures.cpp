// SPDX-License-Identifier: Apache-2.0
#include "sim/compare/measures.hpp"

#include <cmath>
#include <stdexcept>

#include "config/error.hpp"
#include "config/ratio.hpp"
#include "config/statistics_document.hpp"
#include "sim/report.hpp"

namespace degs::sim {
namespace {

struct MeasureRule {
    const char* name;      ///< null: that of the class of slots
    const char* statistic; ///< of a report, which describes it; null: not one of them alone
    bool mean;
    const char* unit = nullptr; ///< this and the next: where no statistic describes it
    const char* sentence = nullptr;
};

constexpr std::array<MeasureRule, kMeasures> kRules{{
    {"cycles", "timing.cycles", false},
    {"preprocessing_cycles", "timing.preprocessing_cycles", false},
    {"latency_ms", "timing.latency_ms", true},
    {"fps", "timing.fps", true},
    {"throughput_fps", "timing.throughput_fps", true},
    {nullptr, nullptr, false}, // nine classes of slots
    {nullptr, nullptr, false},
    {nullptr, nullptr, false},
    {nullptr, nullptr, false},
    {nullptr, nullptr, false},
    {nullptr, nullptr, false},
    {nullptr, nullptr, false},
    {nullptr, nullptr, false},
    {nullptr, nullptr, false},
    {"slots.utilization", "slots.utilization", true},
    {"slots.frame_utilization", "slots.frame_utilization", true},
    {"dram.bytes_read", "dram.bytes_read", false},
    {"dram.bytes_written", "dram.bytes_written", false},
    {"dram.utilization", "dram.utilization", false},
    {"area_mm2", "area.mm2", false},
    {"energy.nj_per_frame", "energy.nj_per_frame", true},
    {"energy.nj_per_pixel", "energy.nj_per_pixel", true},
    {"energy.average_power_w", "energy.average_power_w", true},
    {"ratio.latency", nullptr, true, "", "Latency of the first configuration / latency."},
    {"ratio.throughput", nullptr, true, "", "Throughput / that of the first configuration."},
    {"ratio.latency_per_mm2", nullptr, true, "", "ratio.latency x area of the first / area."},
    {"ratio.throughput_per_mm2", nullptr, true, "", "ratio.throughput x area of the first / area."},
    {"ratio.energy", nullptr, true, "",
     "Frames per joule / that of the first configuration, each frame alone."},
    {"ratio.energy_per_mm2", nullptr, true, "", "ratio.energy x area of the first / area."},
    {"image.psnr_db", "image.psnr_db", false},
    {"image.ssim", "image.ssim", false},
    {"image.max_abs_error", "image.max_abs_error", false},
    {"host.sim_s", "host.sim_s", false},
}};

const MeasureRule& rule_of(Measure measure) {
    return kRules[index_of(measure)];
}

/// A position in kSlotClasses.
int slot_class_of(Measure measure) {
    return index_of(measure) - index_of(Measure::Useful);
}

/// Empty for what does not exist for this run.
std::optional<double> number_of(const Statistic& statistic) {
    if (std::holds_alternative<std::monostate>(statistic.value)) {
        return {};
    }
    if (const auto* whole = std::get_if<std::uint64_t>(&statistic.value)) {
        return static_cast<double>(*whole);
    }
    if (const auto* real = std::get_if<double>(&statistic.value)) {
        return std::isnan(*real) ? std::nullopt : std::optional<double>(*real);
    }
    throw std::logic_error("the statistic '" + statistic.path + "' is not a number");
}

void read_statistics(const RunResult& result, Measures& measures) {
    const std::vector<Statistic> list =
        list_statistics([&result](StatsVisitor& visitor) { describe(result, visitor); });
    for_each_measure([&](Measure m) {
        if (const char* name = rule_of(m).statistic) {
            measures[m] = number_of(find_statistic(list, name));
        }
    });
}

void read_slots(const SlotAccount& slots, Measures& measures) {
    const std::uint64_t total = slots.total();
    for (std::size_t c = 0; total != 0 && c < kSlotClasses.size(); ++c) {
        measures[slot_measure(c)] = ratio_of(slots.*kSlotClasses[c].slots, total);
    }
}

} // namespace

std::vector<Statistic> measure_statistics(const std::vector<Statistic>& report) {
    std::vector<Statistic> list;
    for_each_measure([&](Measure m) {
        const MeasureRule& rule = rule_of(m);
        Statistic row;
        if (rule.statistic != nullptr) {
            row = find_statistic(report, rule.statistic);
        } else if (rule.sentence != nullptr) {
            row.unit = rule.unit;
            row.sentence = rule.sentence;
        } else {
            row.unit = "share";
            row.sentence = kSlotClasses.at(slot_class_of(m)).sentence;
        }
        row.path = name_of(m);
        list.push_back(row);
    });
    return list;
}

std::string name_of(Measure measure) {
    if (const char* name = rule_of(measure).name) {
        return name;
    }
    return std::string("slots.") + kSlotClasses.at(slot_class_of(measure)).name;
}

bool has_mean(Measure measure) {
    return rule_of(measure).mean;
}

Measures measures_of(const RunResult& result) {
    Measures measures;
    try {
        read_statistics(result, measures);
    } catch (const InputError& unknown) { // no user has named it
        throw std::logic_error(unknown.what());
    }
    read_slots(result.accelerator.slots, measures);
    if (result.accelerator.memory_gb_per_s <= 0) { // memory without limit: nothing is counted
        for (Measure m : {Measure::DramRead, Measure::DramWritten, Measure::DramUtilization}) {
            measures[m].reset();
        }
    }
    return measures;
}

} // namespace degs::sim
