// SPDX-License-Identifier: Apache-2.0
// The results of a run of any accelerator: plain values, filled when the run is over.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cost/run_energy.hpp"
#include "dram/activity.hpp"
#include "dram/energy.hpp"
#include "dram/transfer_account.hpp"
#include "modules/kit/job/slot_recorder.hpp"
#include "splat/images/image.hpp"
#include "stats/statistics.hpp"
#include "tlm/latency_histogram.hpp"

namespace degs {

/// How busy one kind of unit was.
struct StageUse {
    std::string name;     ///< key in results
    std::string sentence; ///< which units these are
    bool array = false;   ///< the units whose PE-cycles the slots are; not a number of results
    int units = 0;
    double busy_cycles = 0;
    double busy = 0;
    Counters counters; ///< of the units
    /// Share of its work for a frame that is over when the first task of this frame can start; 0
    /// for stages that tasks pass one after the other. Not a number of results.
    double prepares = 0;
    void describe(StatsVisitor& visitor) const;
};

/// One buffer or ring; fields that a kind of buffer does not have stay 0 and are not reported.
struct BufferUse {
    std::string name;             ///< key in results
    std::string sentence;         ///< what it holds
    std::int64_t bytes = 0;       ///< 0 if the configuration counts cells
    std::uint64_t rings = 0;      ///< parts of the buffer, one per reader
    std::uint64_t depth = 0;      ///< cells per ring
    std::uint64_t high_water = 0; ///< cells
    double mean_fill = 0;
    Cycle full_cycles = 0, empty_cycles = 0;
    Counters counters; ///< of its own kind
    void describe(StatsVisitor& visitor) const;
};

struct StreamUse {
    std::string name;     ///< key in results
    std::string sentence; ///< what it carries
    double prepares = 0;  ///< share of its bytes; see StageUse::prepares
    std::uint64_t bytes_read = 0, bytes_written = 0, requests = 0;
    LatencyHistogram read_latency; ///< date of a request to its last byte; empty on a plain bus
    void describe(StatsVisitor& visitor) const;
};

/// Cycles in which the units of a kind had nothing to do before the memory answered, as a mean of
/// the units. What a run waits for before it starts is left out. Not numbers of results.
struct AnswerWaits {
    double splats = 0; ///< of the first units behind the fetchers
    double pixels = 0; ///< of buffers that write them
};

/// An invariant: two counters of a run that must agree.
struct Conservation {
    std::string law;
    std::uint64_t left = 0, right = 0;
};

/// Dates of one frame of a run; start of the run is 0.
struct FrameDates {
    Cycle preprocessed = 0; ///< the frame's tile lists were complete
    Cycle finished = 0;     ///< the frame's last pixel was in memory
};

/// A tile that lists at least one splat, and what the array did for it.
struct TileRecord {
    std::uint32_t frame = 0;
    int x = 0, y = 0;          ///< its corner in the raster, px
    int width = 0, height = 0; ///< px inside the image
    std::uint64_t splats = 0;  ///< length of its list
    TileActivity activity;
};

/// The result of a run. Counters are sums over all of its frames.
struct AcceleratorResult {
    /// Pixels of splats that were blended.
    std::uint64_t fragments() const { return slots[Slot::Useful] / slots_per_fragment; }
    std::string name;
    int pes = 0;
    double clock_ghz = 1;
    bool array_only = false;
    Cycle cycles = 0; ///< start to the last pixel of the last frame in memory
    std::vector<FrameDates> frames;
    /// Dates of the views, frame by frame, if frames have several; see group_views().
    std::vector<FrameDates> views;
    SlotAccount slots;
    int slots_per_fragment = 1; ///< PE-cycles that a pixel of a splat takes
    ActiveWindow window;        ///< first task issued to last task retired
    std::uint64_t hazards = 0;
    std::vector<StageUse> stages;
    std::vector<BufferUse> buffers;
    std::vector<StreamUse> streams;
    std::vector<cost::Activity> activity; ///< of the blocks in the bill of materials
    cost::RunEnergy energy;
    AnswerWaits waits;
    /// The cycles that the Tile Binner needs at least for the list entries of all frames. Reports
    /// do not show it.
    double binning_cycles = 0;
    int readout_pixels = 0; ///< that all Pixel Buffers read out per cycle; no number of results
    double memory_utilization = 0; ///< share of memory_window in which the data bus was busy
    double memory_gb_per_s = 0;    ///< peak; 0: unlimited
    /// Cycles over which memory is counted: the run, or up to its last answer if that is later.
    Cycle memory_window = 0;
    // Row hits, energy, transfers and activity of the DRAM exist only for a memory with banks and
    // rows.
    std::optional<double> row_hit_rate; ///< share of accesses that found their row open
    std::optional<dram::Energy> dram_energy;
    std::optional<dram::TransferAccount> dram_transfers; ///< by the end of the run
    std::optional<dram::Activity> dram_activity;         ///< by the end of the run
    std::uint64_t tiles_listed = 0;                      ///< that the accelerator has to render
    std::uint64_t tiles = 0;                             ///< that it has rendered
    std::uint64_t background_tiles = 0, tiles_cancelled = 0;
    Cycle stopped = 0; ///< nothing was left to happen at this date
    std::vector<Conservation> conservation;
    std::vector<std::string> unbilled; ///< FIFOs that no buffer and no unit stands for
    /// Keys that the accelerator names for its losses (LossKey::name()), but that limited nothing
    /// in this run, so that to move them changes nothing.
    std::vector<std::string> idle_keys;
    std::vector<std::string> left_out;    ///< sentences for --explain
    std::vector<Image> images;            ///< one per frame
    TimelineRecord timeline;              ///< if the run was asked for one
    std::vector<TileRecord> tile_records; ///< if asked for, in the order of the job
    double elaborate_s = 0, sim_s = 0;    ///< host; sim_s is sc_start() alone
    double functional_s = 0;              ///< host time of its thread; see FunctionalModel
    double waited_s = 0;                  ///< host time; see FunctionalModel::waited_s()
    std::uint64_t activations = 0;        ///< host; see Timebase
    std::chrono::steady_clock::time_point sim_start; ///< host; of sc_start()

    /// The sections timing, stages, slots, dram and buffers of a report.
    void describe(StatsVisitor& visitor) const;
};

/// Moves the dates of a run whose frames are `views` views each to AcceleratorResult::views; a
/// frame is preprocessed and finished with the last of its views.
void group_views(AcceleratorResult& result, std::size_t views);

/// Frames per second while the pipeline is full: of all frames but the first, which starts alone,
/// and the last, behind which no other is preprocessed. Empty for fewer than three frames.
std::optional<double> steady_fps(const AcceleratorResult& result);

} // namespace degs
