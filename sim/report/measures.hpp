// SPDX-License-Identifier: Apache-2.0
// The numbers by which accelerators are compared.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/simulation/run_result.hpp"
#include "stats/statistics_document.hpp"

namespace degs::sim {

/// The numbers that are compared. A ratio above 1 is better than the first configuration.
enum class Measure {
    Cycles,
    PreprocessingCycles,
    BlendingCycles,
    LatencyMs,
    Fps,
    ThroughputFps, ///< of the camera path
    FirstSlot,     ///< shares of the slots, in the order of kSlotClasses, see slot_measure()
    Utilization = FirstSlot + kSlotClasses.size(),
    FrameUtilization,
    DramRead,    ///< bytes
    DramWritten, ///< bytes
    DramUtilization,
    DramPeak, ///< GB/s
    MemoryBound,
    AreaMm2,
    SramBytes,
    NjPerFrame,
    NjPerPixel,
    AveragePowerW,
    LatencyRatio,           ///< latency of the first / latency
    ThroughputRatio,        ///< throughput / throughput of the first
    LatencyRatioPerArea,    ///< LatencyRatio with latency x area
    ThroughputRatioPerArea, ///< ThroughputRatio with throughput / area
    EnergyRatio,            ///< energy per frame of the first / energy per frame
    EnergyRatioPerArea,     ///< EnergyRatio with energy x area
    PsnrDb,
    Ssim,
    MaxAbsError,
    FragmentsPerSplat, ///< of the reference, of the view
    SimS,              ///< host seconds of the run of one frame
    Count
};

constexpr int index_of(Measure measure) {
    return static_cast<int>(measure);
}
constexpr int kMeasures = index_of(Measure::Count);

template <class Act>
void for_each_measure(const Act& act) {
    for (int m = 0; m < kMeasures; ++m) {
        act(static_cast<Measure>(m));
    }
}

/// The share of a class of slots.
constexpr Measure slot_measure(Slot slot) {
    return static_cast<Measure>(index_of(Measure::FirstSlot) + static_cast<int>(slot));
}

/// Which values of a measure are better.
enum class Direction { None, Minimise, Maximise };

/// A number for each measure; one that does not exist is empty, never 0.
class Measures {
public:
    std::optional<double>& operator[](Measure m) { return values_[index_of(m)]; }
    const std::optional<double>& operator[](Measure m) const { return values_[index_of(m)]; }

private:
    std::array<std::optional<double>, kMeasures> values_;
};

/// Name of a measure: a column of compare.csv, and with '/' for '.' its place below a run of
/// compare.json.
std::string name_of(Measure measure);
/// Whether the machine that simulates decides it: then it differs from run to run.
bool is_of_host(Measure measure);
/// Whether its geometric mean over views says something.
bool has_mean(Measure measure);

/// None for what is neither good nor bad by itself, and for what the simulating machine decides.
Direction direction_of(Measure measure);
/// "smaller is better", "larger is better"; empty without a direction.
std::string direction_words(Direction direction);

/// The measure that a column of results.csv is called after. Throws InputError, which begins with
/// `place` and suggests measures, if there is none.
Measure measure_named(const std::string& name, const std::string& place,
                      const std::vector<std::string>& others = {});

/// The keys of a run with their units and meanings, without values. `report` is the list of what a
/// run reports, where most of them are described.
std::vector<Statistic> measure_statistics(const std::vector<Statistic>& report);

/// Measures of a run by itself: all but the ratios. Throws std::logic_error if the description of
/// the result lacks a statistic that a measure comes from.
Measures measures_of(const RunResult& result);

} // namespace degs::sim
