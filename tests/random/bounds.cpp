// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tests/random/habits.hpp"
#include "tests/random/promises.hpp"

namespace degs::trials {
namespace {

/// Collects sentences about what does not hold.
class Complaints {
public:
    template <class Left, class Right>
    void at_most(const std::string& what, Left left, Right right) {
        if (!(left <= right)) { // also for NaN
            list.push_back(what + ": " + std::to_string(left) + " is more than " +
                           std::to_string(right));
        }
    }
    template <class Left, class Right>
    void equal(const std::string& what, Left left, Right right) {
        if (!(left == right)) {
            list.push_back(what + ": " + std::to_string(left) + " is not " + std::to_string(right));
        }
    }
    std::vector<std::string> list;
};

/// Sums of doubles that are counts may be off by rounding.
constexpr double kRounding = 1 + 1e-9;

void check_dates(const Finished& run, Complaints& complaints) {
    const AcceleratorResult& r = run.result;
    const std::vector<FrameDates>& images = r.views.empty() ? r.frames : r.views;
    complaints.equal("frames finished", images.size(), run.frames.size());
    Cycle last = 0;
    for (std::size_t f = 0; f < images.size(); ++f) {
        const std::string frame = "frame " + std::to_string(f);
        complaints.at_most(frame + " is preprocessed, then finished", images[f].preprocessed,
                           images[f].finished);
        complaints.at_most(frame + " is finished after its predecessor", last, images[f].finished);
        last = images[f].finished;
    }
    complaints.equal("the run ends with its last frame", r.cycles, last);
    if (habits_of(run.config).ends_with_its_pixels) {
        complaints.at_most("the blending window ends before the run",
                           r.window.empty() ? 0 : r.window.last, r.cycles);
    }
}

void check_units(const Finished& run, Complaints& complaints) {
    for (const StageUse& stage : run.result.stages) {
        complaints.at_most("share of time in which " + stage.name + " is busy", stage.busy,
                           kRounding);
        complaints.at_most("least share of " + stage.name, 0.0, stage.busy);
    }
    for (const BufferUse& buffer : run.result.buffers) {
        complaints.at_most("fill of " + buffer.name, buffer.high_water, buffer.depth);
        // Rings are watched until their last token has left, after the last pixel.
        const auto filled = buffer.mean_fill * static_cast<double>(run.result.cycles);
        complaints.at_most("mean fill of " + buffer.name, filled,
                           static_cast<double>(std::max(run.result.stopped, run.result.cycles)) *
                               kRounding);
        const std::uint64_t ring_cycles =
            buffer.rings * std::max(run.result.stopped, run.result.cycles);
        complaints.at_most("waiting for room in " + buffer.name, buffer.full_cycles, ring_cycles);
        complaints.at_most("waiting for items in " + buffer.name, buffer.empty_cycles, ring_cycles);
    }
}

std::uint64_t bytes_of(const AcceleratorResult& result, const std::string& stream) {
    for (const StreamUse& use : result.streams) {
        if (use.name == stream) {
            return use.bytes_read + use.bytes_written;
        }
    }
    return 0;
}

void check_memory(const Finished& run, Complaints& complaints) {
    const AcceleratorResult& r = run.result;
    if (r.array_only) {
        return;
    }
    std::uint64_t bytes = 0;
    for (const StreamUse& stream : r.streams) {
        bytes += stream.bytes_read + stream.bytes_written;
    }
    complaints.at_most("share of time in which memory is busy", r.memory_utilization, kRounding);
    if (r.dram_transfers) {
        complaints.equal("bytes that memory accounts for", r.dram_transfers->total(), bytes);
        bytes = r.dram_transfers->on_bus;
    }
    if (r.memory_gb_per_s > 0) {
        const sc_core::sc_time window = ClockDomain(r.clock_ghz).at(r.memory_window);
        complaints.at_most("bytes on the data bus", static_cast<double>(bytes),
                           r.memory_gb_per_s * 1e9 * window.to_seconds() * kRounding);
        complaints.at_most("the run within the window of its memory", r.cycles, r.memory_window);
    }
    std::uint64_t pixels = 0;
    std::uint64_t gaussians = 0;
    for (const FrameWorkload* frame : run.frames) {
        pixels += frame->grid().shown_pixels();
        gaussians += frame->gaussians;
    }
    if (run.config.view_sharing() != ViewSharing::Nothing) { // views of a frame read them once
        gaussians /= run.frames.size() / r.frames.size();
    }
    complaints.at_most("bytes of all pixels", pixels * run.config.records().pixel_bytes,
                       bytes_of(r, "frame_buffer"));
    complaints.at_most("Gaussians read", gaussians, bytes_of(r, "geometry") + bytes_of(r, "means"));
    if (r.row_hit_rate) {
        complaints.at_most("row hit rate", *r.row_hit_rate, 1.0);
        complaints.at_most("least row hit rate", 0.0, *r.row_hit_rate);
    }
    if (r.dram_energy) {
        complaints.at_most("least energy", 0.0, r.dram_energy->total_nj());
    }
}

// No unit works in more cycles than there are.
void check_energy(const Finished& run, Complaints& complaints) {
    const AcceleratorResult& r = run.result;
    const cost::BillOfMaterials bill = run.config.bill();
    const auto cycles = static_cast<double>(std::max(r.stopped, r.cycles));
    for (const cost::Activity& activity : r.activity) {
        const cost::Block& block = bill.block(activity.block);
        complaints.at_most("least activity of " + block.name, 0.0, activity.operations);
        if (block.kind == cost::Block::Kind::Units) {
            complaints.at_most("activity of " + block.name, activity.operations,
                               block.size * cycles * kRounding);
        }
    }
    for (const cost::BlockEnergy& block : r.energy.blocks()) {
        complaints.at_most("energy of " + block.name, block.dynamic_nj + block.leakage_nj,
                           r.energy.total_nj() * kRounding);
    }
}

void check_tiles(const Finished& run, Complaints& complaints) {
    std::uint64_t tiles = 0;
    for (const FrameWorkload* frame : run.frames) {
        tiles += frame->grid().shown_tiles();
    }
    complaints.equal("tiles rendered and background",
                     run.result.tiles + run.result.background_tiles, tiles);
    complaints.at_most("tiles cancelled", run.result.tiles_cancelled, run.result.tiles);
    if (habits_of(run.config).keeps_pixel_order) {
        complaints.equal("hazards", run.result.hazards, std::uint64_t{0});
    }
}

} // namespace

std::vector<std::string> broken_bounds(const Finished& run) {
    Complaints complaints;
    check_dates(run, complaints);
    check_units(run, complaints);
    check_memory(run, complaints);
    check_energy(run, complaints);
    check_tiles(run, complaints);
    return complaints.list;
}

} // namespace degs::trials
