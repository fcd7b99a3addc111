// SPDX-License-Identifier: Apache-2.0
#include "sim/trace/power_trace.hpp"

#include <algorithm>
#include <numeric>

#include "base/ratio.hpp"

namespace degs::sim {
namespace {

using Weights = std::vector<double>; // by step

/// The units whose busy cycles say when a block worked, for blocks of all accelerators.
struct Cause {
    const char* block;
    std::vector<const char*> units;
};

// Tasks cause the accesses of a pixel_buffer, and the blocks whose operations are slots.
const std::vector<const char*> kByTasks{"blending", "row_pes", "systolic_arrays", "pixel_buffer"};

const std::vector<Cause>& causes() {
    static const std::vector<Cause> all{
        {"projection", {"projection"}},
        {"sorting", {"sorting"}},
        {"slicing", {"slicing"}},
        {"span", {"span"}},
        {"span_crossbar", {"span"}},
        {"packing", {"bank"}},
        {"cluster_dispatch", {"fetcher"}},
        {"gaussian_buffer", {"fetcher", "slicing"}},
        {"splat_supply", {"fetcher"}},
        {"feature_buffer", {"bank"}},
        {"span_buffer", {"slicing", "span"}},
        {"packing_buffer", {"bank"}},
        {"row_generation", {"dispatcher"}},
        {"list_buffer", {"sorting"}},
        {"splat_buffer", {"fetcher"}},
        {"row_queues", {"engine"}},
        {"reuse_cache", {"fetcher"}},
        {"grouping", {"grouping"}},
        {"colour", {"colour"}},
        {"group_buffer", {"projection", "colour"}},
        {"vector_units", {"vector_unit"}},
        {"scratchpad", {"vector_unit"}},
    };
    return all;
}

/// Whether a word of the track's name is `unit`, with or without a number: "core_0 bank_12".
bool is_track_of(const std::string& track, const std::string& unit) {
    for (std::size_t begin = 0; begin < track.size();) {
        const std::size_t end = std::min(track.find(' ', begin), track.size());
        const std::string word = track.substr(begin, end - begin);
        const std::size_t digits = word.find_last_not_of("0123456789");
        const bool numbered = digits + 1 < word.size() && word[digits] == '_';
        if ((numbered ? word.substr(0, digits) : word) == unit) {
            return true;
        }
        begin = end + 1;
    }
    return false;
}

void add(Weights& weights, const std::vector<std::uint64_t>& sums) {
    for (std::size_t i = 0; i < std::min(weights.size(), sums.size()); ++i) {
        weights[i] += real_of(sums[i]);
    }
}

/// Cycles of each step that lie in the run.
Weights time_of(const AcceleratorResult& run) {
    Weights cycles(run.timeline.steps(), 0);
    for (std::size_t i = 0; i < cycles.size(); ++i) {
        const Cycle begin = std::min(i * run.timeline.step, run.cycles);
        cycles[i] = real_of(std::min(begin + run.timeline.step, run.cycles) - begin);
    }
    return cycles;
}

Weights tasks_of(const TimelineRecord& timeline) {
    Weights tasks(timeline.steps(), 0);
    for (const TimelineCounter& counter : timeline.counters) {
        if (counter.group == "slots" && (counter.name == "useful" || counter.name == "boundary" ||
                                         counter.name == "terminated")) {
            add(tasks, counter.sums);
        }
    }
    return tasks;
}

Weights bytes_of(const TimelineRecord& timeline, const std::string& way) {
    Weights bytes(timeline.steps(), 0);
    for (const TimelineCounter& counter : timeline.counters) {
        const bool same =
            counter.name.size() >= way.size() &&
            counter.name.compare(counter.name.size() - way.size(), way.size(), way) == 0;
        if (counter.group == "memory" && same) {
            add(bytes, counter.sums);
        }
    }
    return bytes;
}

/// When the units worked that cause what `block` does; all zeros if none is known.
Weights work_of(const TimelineRecord& timeline, const std::string& block) {
    if (std::find(kByTasks.begin(), kByTasks.end(), block) != kByTasks.end()) {
        return tasks_of(timeline);
    }
    Weights work(timeline.steps(), 0);
    for (const Cause& cause : causes()) {
        for (const char* unit : block == cause.block ? cause.units : std::vector<const char*>{}) {
            for (const TimelineTrack& track : timeline.tracks) {
                for (const TimelineState& state : track.states) {
                    if (state.kind == TimelineState::Kind::Busy && is_track_of(track.name, unit)) {
                        add(work, state.cycles);
                    }
                }
            }
        }
    }
    return work;
}

double sum_of(const Weights& weights) {
    return std::accumulate(weights.begin(), weights.end(), 0.0);
}

/// Adds energies to a series so that no energy is lost.
class Spreader {
public:
    explicit Spreader(const AcceleratorResult& run) : time_(time_of(run)) {
        constexpr double kMwPerW = 1e3;
        mw_per_nj_ = kMwPerW * run.clock_ghz / real_of(run.timeline.step); // nJ / ns = W
    }
    void add(PowerSeries& series, double nj, const Weights& weights) const {
        const bool known = sum_of(weights) > 0;
        const Weights& by = known ? weights : time_;
        const double whole = sum_of(by);
        series.mw.resize(by.size(), 0);
        for (std::size_t i = 0; whole > 0 && i < by.size(); ++i) {
            series.mw[i] += nj * by[i] / whole * mw_per_nj_;
        }
    }
    const Weights& time() const { return time_; }

private:
    Weights time_;
    double mw_per_nj_ = 0;
};

/// What time alone costs is spread over the run, and the rest by the bytes of its direction.
PowerSeries memory_power(const Spreader& spreader, const cost::Technology::Dram& bus,
                         const AcceleratorResult& run) {
    constexpr double kNjPerByte = 8e-3; // of a pJ per bit
    const Weights read = bytes_of(run.timeline, " read");
    const Weights written = bytes_of(run.timeline, " written");
    double read_nj = kNjPerByte * bus.pj_per_bit * sum_of(read);
    double written_nj = kNjPerByte * bus.write_pj_per_bit * sum_of(written);
    double rows_nj = 0;
    if (run.dram_energy) {
        read_nj = run.dram_energy->read_nj;
        written_nj = run.dram_energy->write_nj;
        rows_nj = run.dram_energy->activate_nj;
    }
    Weights both = read;
    std::transform(both.begin(), both.end(), written.begin(), both.begin(), std::plus<>());
    PowerSeries series{"memory", {}};
    spreader.add(series, read_nj, read);
    spreader.add(series, written_nj, written);
    spreader.add(series, rows_nj, both);
    spreader.add(series, run.energy.dram_nj().value_or(0) - read_nj - written_nj - rows_nj,
                 spreader.time());
    return series;
}

} // namespace

std::vector<PowerSeries> power_of(const AcceleratorConfig& config, const AcceleratorResult& run) {
    const Spreader spreader(run);
    std::vector<PowerSeries> all;
    for (const cost::BlockEnergy& block : run.energy.blocks()) {
        PowerSeries series{block.name, {}};
        spreader.add(series, block.leakage_nj, spreader.time());
        spreader.add(series, block.dynamic_nj, work_of(run.timeline, block.name));
        all.push_back(std::move(series));
    }
    if (run.energy.dram_nj()) {
        all.push_back(memory_power(spreader, config.cost.dram, run));
    }
    return all;
}

} // namespace degs::sim
