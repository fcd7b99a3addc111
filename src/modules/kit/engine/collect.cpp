// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/engine/collect.hpp"

#include <utility>

#include "base/grouped_number.hpp"
#include "base/ratio.hpp"

namespace degs {

namespace {

void collect_written(AcceleratorResult& result, const KeptList<Cycle>& written) {
    result.frames.resize(std::max(result.frames.size(), written.size()));
    for (std::size_t f = written.first(); f < written.size(); ++f) {
        result.frames[f].finished = std::max(result.frames[f].finished, written[f]);
    }
}

} // namespace

void add_activity(AcceleratorResult& result, const char* block, double operations) {
    result.activity.push_back({block, operations});
}

void add_pixel_activity(AcceleratorResult& result, const RenderJob& job, double pixel_bytes) {
    const std::uint64_t tasks = result.slots.executed() / result.slots_per_fragment;
    const std::uint64_t accesses = tasks + result.fragments() + job.tiles.pixels();
    add_activity(result, "pixel_buffer", real_of(accesses) * pixel_bytes);
}

void collect_frames(AcceleratorResult& result, const RenderJob& job, const PixelBuffers& buffers,
                    const BackgroundWriter& background) {
    collect_written(result, background.frames_written());
    result.cycles = background.stats().finished;
    result.background_tiles = job.background_tiles;
    for (const auto& buffer : buffers) {
        collect_written(result, buffer->frames_written());
        result.cycles = std::max(result.cycles, buffer->stats().finished);
    }
    // Images leave in order, even if engines had the tiles of a later frame done before.
    for (std::size_t f = 1; f < result.frames.size(); ++f) {
        result.frames[f].finished =
            std::max(result.frames[f].finished, result.frames[f - 1].finished);
    }
}

void add_stage(AcceleratorResult& result, const Title& title, std::size_t units,
               std::uint64_t busy_cycles, Counters counters) {
    if (units == 0) {
        return;
    }
    StageUse stage;
    stage.name = title.name;
    stage.sentence = title.sentence;
    stage.array = title.array;
    stage.prepares = title.prepares;
    stage.units = static_cast<int>(units);
    stage.busy_cycles = static_cast<double>(busy_cycles);
    stage.busy = ratio_of(busy_cycles, units * result.cycles);
    stage.counters = std::move(counters);
    result.stages.push_back(std::move(stage));
}

BufferUse& add_buffer(AcceleratorResult& result, const Title& title, std::int64_t bytes) {
    BufferUse buffer;
    buffer.name = title.name;
    buffer.sentence = title.sentence;
    buffer.bytes = bytes;
    return result.buffers.emplace_back(std::move(buffer));
}

void add_buffer(AcceleratorResult& result, const Title& title, std::int64_t bytes,
                std::uint64_t depth, const RingUse& use) {
    BufferUse& buffer = add_buffer(result, title, bytes);
    buffer.depth = depth;
    buffer.rings = use.depth / buffer.depth;
    buffer.high_water = use.high_water;
    buffer.mean_fill = ratio_of(use.occupied_cycles, use.depth * result.cycles);
    buffer.full_cycles = use.full_cycles;
    buffer.empty_cycles = use.empty_cycles;
}

void add_pixel_buffer(AcceleratorResult& result, std::int64_t bytes, int contexts,
                      const PixelBuffers& buffers) {
    BufferUse& use =
        add_buffer(result, {"pixel_buffer", "State of the pixels of the tiles in flight."}, bytes);
    use.counters.count("contexts", contexts, "tiles", "Tiles that it holds at once.");
    use.counters.add(buffers);
    result.waits.pixels =
        ratio_of(sum_of(buffers, &PixelBuffer::Stats::write_wait), buffers.size());
    for (const auto& buffer : buffers) {
        result.readout_pixels += buffer->pixels_per_cycle();
    }
}

void add_slots(AcceleratorResult& result, const SlotAccount& slots, const ActiveWindow& window) {
    result.slots += slots;
    result.window.include(window);
}

void close_slots(AcceleratorResult& result, const ActiveWindow& window, std::uint64_t width) {
    if (window.empty()) {
        result.slots[Slot::Drain] += result.window.cycles() * width;
    } else {
        result.slots[Slot::Starved] += (window.first - result.window.first) * width;
        result.slots[Slot::Drain] += (result.window.last - window.last) * width;
    }
}

void explain_tiles(AcceleratorResult& result, std::uint64_t records_cancelled) {
    auto& out = result.left_out;
    out.push_back(grouped(result.background_tiles) + " of " +
                  grouped(result.tiles + result.background_tiles) +
                  " tiles list no splat: they are written as background and enter no unit.");
    out.push_back(grouped(result.tiles_cancelled) +
                  " tiles were cancelled before the end of their list because all their pixels had "
                  "ended: " +
                  grouped(records_cancelled) + " splat records were not fetched.");
}

} // namespace degs
