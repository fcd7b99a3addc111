// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>

#include "modules/degs/array/task_blender.hpp"
#include "modules/kit/job/render_job.hpp"

namespace degs {

/// Blends tasks that nothing keeps apart: the PEs of an array slice without a scoreboard. A task
/// reads the pixel state that is written back at its date, and its own result is written back
/// `writeback_cycles` later. A task that comes earlier than that builds on the older state, and its
/// write-back replaces the result that it did not see. Between two calls the data path holds what
/// is written back; its counts of updates are those of the tasks executed.
class EarlyBlender {
public:
    EarlyBlender(RenderJob& job, int writeback_cycles, bool tests = false)
        : job_(job), blender_(job, tests), latency_(writeback_cycles) {}

    /// Executes the tasks of `run` that are in this packet at `date`, which must not fall from call
    /// to call.
    BlendOutcome blend(const TaskRun& run, Cycle date);
    /// Writes back all pending updates of a tile, of which no further task follows.
    void finish(TileNumber tile);
    /// Pixels so far that a task updated although an earlier update was not written back yet.
    std::uint64_t hazards() const { return hazards_; }

private:
    struct WriteBack {
        Cycle date = 0;
        TileNumber tile = 0;
        int context = 0, row = 0, column = 0;
        PixelValue value;
    };
    void write(const WriteBack& update);
    std::uint32_t pending(const BlendTask& task, TileNumber tile) const;

    RenderJob& job_;
    TaskBlender blender_;
    Cycle latency_;
    std::deque<WriteBack> under_way_; // by date
    std::uint64_t hazards_ = 0;
};

} // namespace degs
