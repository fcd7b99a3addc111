// SPDX-License-Identifier: Apache-2.0
#include "sim/report/measures.hpp"

#include <cmath>
#include <stdexcept>

#include "base/ratio.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "sim/report/report.hpp"
#include "stats/statistics_document.hpp"

namespace degs::sim {
namespace {

struct MeasureRule {
    const char* name = nullptr; ///< null: that of the class of slots
    const char* statistic =
        nullptr; ///< of a report, which describes it; null: not one of them alone
    bool mean = false;
    Direction better = Direction::None;
    const char* unit = nullptr; ///< this and the next: where no statistic describes it
    const char* sentence = nullptr;
    const SlotClass* slot = nullptr; ///< whose share it is
};

constexpr Direction kNone = Direction::None;
constexpr Direction kLeast = Direction::Minimise;
constexpr Direction kMost = Direction::Maximise;

// The measures before and behind the shares of the slots.
constexpr std::array<MeasureRule, 6> kBeforeSlots{{
    {"cycles", "timing.cycles", false, kLeast},
    {"preprocessing_cycles", "timing.preprocessing_cycles", false, kLeast},
    {"blending_cycles", "timing.blending_cycles", false, kLeast},
    {"latency_ms", "timing.latency_ms", true, kLeast},
    {"fps", "timing.fps", true, kMost},
    {"throughput_fps", "timing.throughput_fps", true, kMost},
}};
constexpr std::array<MeasureRule, 23> kBehindSlots{{
    {"slots.utilization", "slots.utilization", true, kMost},
    {"slots.frame_utilization", "slots.frame_utilization", true, kMost},
    {"dram.bytes_read", "dram.bytes_read", false, kLeast},
    {"dram.bytes_written", "dram.bytes_written", false, kLeast},
    {"dram.utilization", "dram.utilization", false, kNone}, // a busy bus may be used well or ill
    {"dram.peak_gb_per_s", "dram.peak_gb_per_s", false, kNone},
    {"memory_bound", "stages.memory_bound", false, kLeast},
    {"area_mm2", "area.mm2", false, kLeast},
    {"sram_bytes", "area.sram_bytes", false, kLeast},
    {"energy.nj_per_frame", "energy.nj_per_frame", true, kLeast},
    {"energy.nj_per_pixel", "energy.nj_per_pixel", true, kLeast},
    {"energy.average_power_w", "energy.average_power_w", true, kLeast},
    {"ratio.latency", nullptr, true, kMost, "", "Latency of the first configuration / latency."},
    {"ratio.throughput", nullptr, true, kMost, "", "Throughput / that of the first configuration."},
    {"ratio.latency_per_mm2", nullptr, true, kMost, "",
     "ratio.latency x area of the first / area."},
    {"ratio.throughput_per_mm2", nullptr, true, kMost, "",
     "ratio.throughput x area of the first / area."},
    {"ratio.energy", nullptr, true, kMost, "",
     "Frames per joule / that of the first configuration, each frame alone."},
    {"ratio.energy_per_mm2", nullptr, true, kMost, "", "ratio.energy x area of the first / area."},
    {"image.psnr_db", "image.psnr_db", false, kMost},
    {"image.ssim", "image.ssim", false, kMost},
    {"image.max_abs_error", "image.max_abs_error", false, kLeast},
    {"workload.fragments_per_splat", "workload.fragments_per_splat", false, kNone},
    {"host.sim_s", "host.sim_s", false, kNone},
}};

constexpr std::array<MeasureRule, kMeasures> all_rules() {
    static_assert(kBeforeSlots.size() + kSlotClasses.size() + kBehindSlots.size() == kMeasures);
    std::array<MeasureRule, kMeasures> rules{};
    std::size_t next = 0;
    for (const MeasureRule& rule : kBeforeSlots) {
        rules[next++] = rule;
    }
    for (const SlotClass& slot : kSlotClasses) {
        rules[next].slot = &slot;
        rules[next++].better = slot.slot == Slot::Useful ? kMost : kLeast;
    }
    for (const MeasureRule& rule : kBehindSlots) {
        rules[next++] = rule;
    }
    return rules;
}
constexpr std::array<MeasureRule, kMeasures> kRules = all_rules();

const MeasureRule& rule_of(Measure measure) {
    return kRules[index_of(measure)];
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
    for (const SlotClass& each : kSlotClasses) {
        if (total != 0) {
            measures[slot_measure(each.slot)] = ratio_of(slots[each.slot], total);
        }
    }
}

/// Whether `part` stands in `name` between dots and underscores.
bool has_word(const std::string& name, const std::string& part) {
    const auto ends = [&name](std::size_t at) {
        return at == 0 || at == name.size() || std::string("._").find(name[at]) < 2 ||
               std::string("._").find(name[at - 1]) < 2;
    };
    for (std::size_t at = name.find(part); at != std::string::npos; at = name.find(part, at + 1)) {
        if (ends(at) && ends(at + part.size())) {
            return true;
        }
    }
    return false;
}

/// The names of which `word` is a part, as "latency" is of "latency_ms"; else the one that it most
/// likely misspells.
std::vector<std::string> meant_by(const std::string& word, const std::vector<std::string>& names) {
    constexpr std::size_t kMostSuggestions = 3;
    std::vector<std::string> meant;
    for (const std::string& name : names) {
        if (!word.empty() && meant.size() < kMostSuggestions && has_word(name, word)) {
            meant.push_back(name);
        }
    }
    const std::string near = config_words::nearest(word, names);
    if (meant.empty() && !near.empty()) {
        meant.push_back(near);
    }
    return meant;
}

/// "'a', 'b' or 'c'".
std::string alternatives(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t n = 0; n < names.size(); ++n) {
        text += n == 0 ? "" : n + 1 == names.size() ? " or " : ", ";
        text += config_words::quote(names[n]);
    }
    return text;
}

constexpr const char* kWhereListed = "'degs config --stats --of compare' lists the measures.";

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
            row.sentence = rule.slot->sentence;
        }
        row.path = name_of(m);
        list.push_back(row);
    });
    return list;
}

std::string name_of(Measure measure) {
    const MeasureRule& rule = rule_of(measure);
    return rule.slot != nullptr ? std::string("slots.") + rule.slot->name : rule.name;
}

bool is_of_host(Measure measure) {
    return name_of(measure).rfind("host.", 0) == 0;
}

bool has_mean(Measure measure) {
    return rule_of(measure).mean;
}

Direction direction_of(Measure measure) {
    return rule_of(measure).better;
}

std::string direction_words(Direction direction) {
    return direction == Direction::Minimise   ? "smaller is better"
           : direction == Direction::Maximise ? "larger is better"
                                              : "";
}

Measure measure_named(const std::string& name, const std::string& place,
                      const std::vector<std::string>& others) {
    std::optional<Measure> found;
    std::vector<std::string> names = others;
    for_each_measure([&](Measure measure) {
        names.push_back(name_of(measure));
        if (name_of(measure) == name) {
            found = measure;
        }
    });
    if (!found) {
        const std::string meant = alternatives(meant_by(name, names));
        throw InputError(place + " names " + config_words::quote(name) + ", which is no measure" +
                         (meant.empty() ? "" : "; did you mean " + meant + "?") +
                         (meant.empty() ? "; " : " ") + kWhereListed);
    }
    return *found;
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
