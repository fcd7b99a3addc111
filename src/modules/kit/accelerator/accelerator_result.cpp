// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/accelerator/accelerator_result.hpp"

#include <algorithm>

#include "base/ratio.hpp"
#include "modules/kit/accelerator/waiting_causes.hpp"

namespace degs {
namespace {

/// Empty where there is nothing to divide by.
std::optional<double> ratio(double part, double whole) {
    return whole == 0 ? std::nullopt : std::optional<double>(part / whole);
}

std::optional<double> share(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? std::nullopt : std::optional<double>(ratio_of(part, whole));
}

std::vector<std::uint64_t> ends_of(const std::vector<FrameDates>& frames) {
    std::vector<std::uint64_t> ends;
    ends.reserve(frames.size());
    for (const FrameDates& frame : frames) {
        ends.push_back(frame.finished);
    }
    return ends;
}

/// The first frame has the accelerator to itself until the next one's preprocessing starts.
void describe_timing(const AcceleratorResult& run, StatsVisitor& v) {
    const FrameDates first = run.frames.empty() ? FrameDates() : run.frames.front();
    const double frame_ns = rate_of(first.finished, run.clock_ghz);
    v.begin_section("timing", "Dates count from the start of the run.");
    v.count("cycles", run.cycles, "cycles", "Last pixel of the last frame in memory.");
    v.real("latency_ms", frame_ns * 1e-6, "ms", "Last pixel of the first frame in memory.");
    v.real("fps", ratio(1e9, frame_ns), "frames/s", "1000 / latency_ms.");
    v.real("clock_ghz", run.clock_ghz, "GHz", "Clock of the configuration.");
    v.count("preprocessing_cycles", first.preprocessed, "cycles",
            "All tile lists of the first frame complete.");
    v.count("blending_cycles", run.window.cycles(), "cycles",
            "From the first task executed to the last, over all frames.");
    v.count("frames", run.frames.size(), "frames", "Frames of the run.");
    v.list("frame_finished_cycles", ends_of(run.frames), "cycles",
           "Last pixel of each frame in memory.");
    v.real("throughput_fps", steady_fps(run), "frames/s",
           "Steady state: (frames - 2) / time from the first frame's end to that of the last but "
           "one; null below 3 frames.");
    v.truth("array_only", run.array_only,
            "The run was of the rasterisation array alone (--array-only).");
    v.end_section();
}

void describe_stages(const AcceleratorResult& run, StatsVisitor& v) {
    v.begin_section("stages", "How busy each kind of unit was.");
    for (const StageUse& stage : run.stages) {
        v.section(stage.name, stage, stage.sentence);
    }
    v.text("limited_by", limiting_stage(run),
           "memory if memory_bound is more than a half, else the busiest stage: a hint, no proof.");
    v.real("memory_bound", WaitingCauses(run).lost_for_memory(), "share",
           "PE-cycles of the run that were lost for the bandwidth of memory; null with "
           "--array-only.");
    v.end_section();
}

void describe_slots(const AcceleratorResult& run, StatsVisitor& v) {
    const auto date = [&run](Cycle cycle) {
        return run.window.empty() ? std::nullopt : std::optional<std::uint64_t>(cycle);
    };
    v.begin_section("slots", "Where the PE-cycles of the blending window went.");
    v.count("pes", run.pes, "PEs", "Processing elements.");
    v.count("total", run.slots.total(), "PE-cycles",
            "PEs x timing.blending_cycles: the sum of the classes that follow.");
    run.slots.describe(v);
    v.real("utilization", share(run.slots[Slot::Useful], run.slots.total()), "share",
           "useful / total; null if nothing was blended.");
    v.real("frame_utilization", share(run.slots[Slot::Useful], run.pes * run.cycles), "share",
           "useful / (PEs x timing.cycles).");
    v.count("window_first", date(run.window.first), "cycles",
            "Date of the first executed task; null if there is none.");
    v.count("window_last", date(run.window.last), "cycles",
            "Date of the last executed task; null if there is none.");
    v.count("hazards", run.hazards, "pixels",
            "Updated again before their write-back; 0 unless scheduler.scoreboard is off.");
    v.end_section();
}

void describe_dram(const AcceleratorResult& run, StatsVisitor& v) {
    const bool limited = run.memory_gb_per_s > 0;
    const auto if_limited = [limited](double value) {
        return limited ? std::optional<double>(value) : std::nullopt;
    };
    std::uint64_t read = 0;
    std::uint64_t written = 0;
    for (const StreamUse& stream : run.streams) {
        read += stream.bytes_read;
        written += stream.bytes_written;
    }
    v.begin_section("dram", "Traffic of the main memory, as transferred: whole accesses.");
    v.count("bytes_read", read, "bytes", "Bytes read.");
    v.count("bytes_written", written, "bytes", "Bytes written.");
    v.count("window_cycles",
            limited ? std::optional<std::uint64_t>(run.memory_window) : std::nullopt, "cycles",
            "Over which this section counts; null with --array-only.");
    v.real("peak_gb_per_s", if_limited(run.memory_gb_per_s), "GB/s",
           "Configured bandwidth; null with --array-only.");
    v.real("utilization", if_limited(run.memory_utilization), "share",
           "Share of the window in which the data bus was occupied; null likewise.");
    v.real("row_hit_rate", run.row_hit_rate, "share",
           "Accesses that found their row open; null with the model bus.");
    if (v.wants(run.dram_energy.has_value())) {
        v.section("energy_nj", run.dram_energy.value_or(dram::Energy()),
                  "Energy of the DRAM by event; null with the model bus.");
    } else {
        v.nothing("energy_nj", "Energy of the DRAM by event.");
    }
    if (v.wants(run.dram_transfers.has_value())) {
        v.section(
            "transfers", run.dram_transfers.value_or(dram::TransferAccount()),
            "What has become of bytes_read + bytes_written by the end of the run; with lpddr5 "
            "only.");
    }
    if (v.wants(run.dram_activity.has_value())) {
        v.section("channels", run.dram_activity.value_or(dram::Activity()),
                  "What the channels did by the end of the run; with lpddr5 only. Sums over all of "
                  "them, except for the list.");
    }
    v.begin_section("streams", "Traffic by kind of record.");
    for (const StreamUse& stream : run.streams) {
        v.section(stream.name, stream, stream.sentence);
    }
    v.end_section();
    v.end_section();
}

} // namespace

void StageUse::describe(StatsVisitor& visitor) const {
    visitor.count("units", units, "units", "Units of this kind.");
    visitor.real("busy_cycles", busy_cycles, "cycles",
                 "Cycles in which a unit worked, summed over the units.");
    visitor.real("busy", busy, "share",
                 "busy_cycles / (units x timing.cycles): of the whole run, not of the window.");
    counters.describe(visitor);
}

void BufferUse::describe(StatsVisitor& visitor) const {
    if (bytes != 0) {
        visitor.count("bytes", bytes, "bytes", "Configured capacity of the whole buffer.");
    }
    if (depth != 0) {
        visitor.count("rings", rings, "rings", "Parts of the buffer, one for each reader.");
        visitor.count("depth", depth, "cells", "Cells of one ring.");
        visitor.peak("high_water", high_water, "cells", "Most cells of one ring filled at once.");
        visitor.real("mean_fill", mean_fill, "share", "Cells filled, mean over the run.");
        visitor.count("full_cycles", full_cycles, "cycles",
                      "Writers waiting for room, summed over the rings.");
        visitor.count("empty_cycles", empty_cycles, "cycles",
                      "Readers waiting for an item, summed over the rings.");
    }
    counters.describe(visitor);
}

void StreamUse::describe(StatsVisitor& visitor) const {
    visitor.count("bytes_read", bytes_read, "bytes", "Bytes read.");
    visitor.count("bytes_written", bytes_written, "bytes", "Bytes written.");
    visitor.count("requests", requests, "requests", "Reads and writes.");
    if (visitor.wants(read_latency.samples() != 0)) {
        visitor.begin_section("read_latency_ns",
                              "From the date of a read to its last byte; with lpddr5 only.");
        read_latency.describe_summary(visitor);
        visitor.end_section();
    }
}

void AcceleratorResult::describe(StatsVisitor& visitor) const {
    describe_timing(*this, visitor);
    describe_stages(*this, visitor);
    describe_slots(*this, visitor);
    describe_dram(*this, visitor);
    visitor.begin_section("buffers", "How full the memories on the chip were.");
    for (const BufferUse& buffer : buffers) {
        visitor.section(buffer.name, buffer, buffer.sentence);
    }
    visitor.end_section();
}

void group_views(AcceleratorResult& result, std::size_t views) {
    result.views.swap(result.frames);
    result.frames.assign(result.views.size() / views, {});
    for (std::size_t v = 0; v < result.views.size(); ++v) {
        FrameDates& frame = result.frames[v / views];
        frame.preprocessed = std::max(frame.preprocessed, result.views[v].preprocessed);
        frame.finished = std::max(frame.finished, result.views[v].finished);
    }
}

std::optional<double> steady_fps(const AcceleratorResult& result) {
    const auto& frames = result.frames;
    if (frames.size() < 3) {
        return {};
    }
    const Cycle cycles = frames[frames.size() - 2].finished - frames.front().finished;
    if (cycles == 0) {
        return {};
    }
    return ratio_of(frames.size() - 2, cycles) * result.clock_ghz * 1e9;
}

} // namespace degs
