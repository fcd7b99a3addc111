// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/array/early_blender.hpp"

#include <algorithm>
#include <array>

namespace degs {

BlendOutcome EarlyBlender::blend(const TaskRun& run, Cycle date) {
    while (!under_way_.empty() && under_way_.front().date <= date) {
        write(under_way_.front());
        under_way_.pop_front();
    }
    DataPath& path = *job_.path;
    BlendTask task = run.task;
    task.mask = run.part;
    hazards_ += __builtin_popcount(pending(task, run.tile));
    std::array<PixelValue, 32> seen; // by bit of the mask
    for (std::uint32_t left = task.mask; left != 0; left &= left - 1) {
        const int i = __builtin_ctz(left);
        seen[i] = path.read_pixel(task.context, task.row, task.column + i);
    }
    const BlendOutcome outcome = blender_.blend(task, run.tile);
    for (std::uint32_t left = task.mask; left != 0; left &= left - 1) {
        const int i = __builtin_ctz(left);
        const int column = task.column + i;
        under_way_.push_back({date + latency_, run.tile, task.context, task.row, column,
                              path.read_pixel(task.context, task.row, column)});
        path.write_pixel(task.context, task.row, column, seen[i]);
    }
    return outcome;
}

void EarlyBlender::finish(TileNumber tile) {
    for (const WriteBack& update : under_way_) {
        if (update.tile == tile) {
            write(update);
        }
    }
    under_way_.erase(
        std::remove_if(under_way_.begin(), under_way_.end(),
                       [tile](const WriteBack& update) { return update.tile == tile; }),
        under_way_.end());
}

// The tasks whose pixels have an update that is not written back.
std::uint32_t EarlyBlender::pending(const BlendTask& task, TileNumber tile) const {
    std::uint32_t pixels = 0;
    for (const WriteBack& update : under_way_) {
        const int i = update.column - task.column;
        if (update.tile == tile && update.row == task.row && i >= 0 && i < 32) {
            pixels |= 1U << i;
        }
    }
    return pixels & task.mask;
}

void EarlyBlender::write(const WriteBack& update) {
    job_.path->write_pixel(update.context, update.row, update.column, update.value);
}

} // namespace degs
