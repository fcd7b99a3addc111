// SPDX-License-Identifier: Apache-2.0
// Turns the counters of blocks into an AcceleratorResult.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "base/ratio.hpp"
#include "modules/kit/accelerator/accelerator_result.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/pixels/background_writer.hpp"
#include "modules/kit/pixels/pixel_buffer.hpp"

namespace degs {

/// Sums one counter over units of a kind.
template <class Units, class Stats>
std::uint64_t sum_of(const Units& units, std::uint64_t Stats::*counter) {
    std::uint64_t sum = 0;
    for (const auto& unit : units) {
        sum += unit->stats().*counter;
    }
    return sum;
}

/// A stage or a buffer in results: its key and what it is.
struct Title {
    const char* name;
    const char* sentence;
    bool array = false;  ///< see StageUse
    double prepares = 0; ///< see StageUse
};

/// Adds a stage, or nothing if there are no units. The cycles of `result` must be known.
void add_stage(AcceleratorResult& result, const Title& title, std::size_t units,
               std::uint64_t busy_cycles, Counters counters);

/// Statistics of the rings that stand for one buffer.
struct RingUse {
    std::size_t depth = 0, high_water = 0;
    std::uint64_t items = 0;
    Cycle full_cycles = 0, empty_cycles = 0, occupied_cycles = 0;
    Cycle late_cycles = 0; ///< of the reader of each, see DatedFifo
};

/// Adds what other rings did.
inline RingUse& operator+=(RingUse& sum, const RingUse& other) {
    sum.depth += other.depth;
    sum.high_water = std::max(sum.high_water, other.high_water);
    sum.items += other.items;
    sum.full_cycles += other.full_cycles;
    sum.empty_cycles += other.empty_cycles;
    sum.late_cycles += other.late_cycles;
    sum.occupied_cycles += other.occupied_cycles;
    return sum;
}

/// What a ring of `depth` cells did, by its DatedFifo::Stats.
template <class Stats>
RingUse use_of(const Stats& stats, std::size_t depth) {
    return {depth,
            stats.high_water,
            stats.items,
            stats.full_cycles,
            stats.empty_cycles,
            stats.occupied_cycles,
            stats.late_cycles};
}

/// What rings did whose cells a buffer of the results stands for.
template <class T>
RingUse use_of(const std::vector<std::unique_ptr<DatedFifo<T>>>& rings) {
    RingUse use;
    for (const auto& ring : rings) {
        use += use_of(ring->stats(), ring->depth());
        ring->set_billed();
    }
    return use;
}

/// A buffer of `bytes` without rings; its counters follow.
BufferUse& add_buffer(AcceleratorResult& result, const Title& title, std::int64_t bytes);
/// A buffer of `bytes` made of rings of `depth` cells each.
void add_buffer(AcceleratorResult& result, const Title& title, std::int64_t bytes,
                std::uint64_t depth, const RingUse& use);

/// The Splat Fetchers of any accelerator.
inline constexpr Title kFetching{"fetching", "Splat Fetchers, busy when they ask for records."};

/// What a block of the bill of materials has done: cycles of work of its units, or bytes moved.
void add_activity(AcceleratorResult& result, const char* block, double operations);
inline void add_activity(AcceleratorResult& result, const std::vector<cost::Activity>& blocks) {
    result.activity.insert(result.activity.end(), blocks.begin(), blocks.end());
}
inline void add_activity(AcceleratorResult& result, const char* block, std::uint64_t operations) {
    add_activity(result, block, real_of(operations));
}
/// Adds the activity of "pixel_buffer": a task reads the state of its pixel and writes it if it
/// blends, and every pixel of the tiles is read out once. The slots of `result` must be known.
void add_pixel_activity(AcceleratorResult& result, const RenderJob& job, double pixel_bytes);

using PixelBuffers = std::vector<std::unique_ptr<PixelBuffer>>;

/// Fills in the dates of the frames, the cycles of the run and the background tiles. It comes
/// first, because everything that is relative to the run needs its cycles.
void collect_frames(AcceleratorResult& result, const RenderJob& job, const PixelBuffers& buffers,
                    const BackgroundWriter& background);
/// `bytes`: of all instances together.
void add_pixel_buffer(AcceleratorResult& result, std::int64_t bytes, int contexts,
                      const PixelBuffers& buffers);
/// Slots of several arrays with windows of their own: first each of them is added, then each, of
/// `width` PEs, has its cycles between the window of all and its own counted.
void add_slots(AcceleratorResult& result, const SlotAccount& slots, const ActiveWindow& window);
void close_slots(AcceleratorResult& result, const ActiveWindow& window, std::uint64_t width);
/// Both for `arrays` whose stats() have slots and a window.
template <class Arrays>
void add_array_slots(AcceleratorResult& result, const Arrays& arrays, std::uint64_t width) {
    for (const auto& array : arrays) {
        add_slots(result, array->stats().slots, array->stats().window);
    }
    for (const auto& array : arrays) {
        close_slots(result, array->stats().window, width);
    }
}
/// Adds the work that empty and finished tiles saved, for --explain.
void explain_tiles(AcceleratorResult& result, std::uint64_t records_cancelled);

} // namespace degs
