// SPDX-License-Identifier: Apache-2.0
// Splats, spans and tasks for the data paths of number sets.
#pragma once

#include "splat/numbers/number_set.hpp"
#include "tests/splat/pixels/data_path_fixture.hpp"

namespace degs::test {

constexpr int kTile = 32;
constexpr int kX = 1984; // corner of the tile in the image
constexpr int kY = 992;

inline NumberSet with_ends(NumberSet set, SpanEnds ends, int delta = 0) {
    set.ends = ends;
    set.delta = delta;
    return set;
}

/// The tasks of a span, in segments of 16 px.
inline std::vector<BlendTask> tasks_of(const RowSpan& span) {
    std::vector<BlendTask> tasks;
    for (int column = 0; column < kTile; column += 16) {
        BlendTask task;
        task.g0 = span.g0;
        task.d0 = span.d0;
        task.splat = span.splat;
        task.row = span.y;
        task.column = static_cast<std::int16_t>(column);
        task.offset = static_cast<std::int16_t>(column - span.base);
        for (int x = span.x0; x < span.x0 + span.length; ++x) {
            task.mask |= x >= column && x < column + 16 ? 1U << (x - column) : 0U;
        }
        if (task.mask != 0) {
            tasks.push_back(task);
        }
    }
    return tasks;
}

inline std::vector<ProjectedSplat> random_splats(unsigned seed, int count) {
    std::mt19937 random(seed);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < count; ++i) {
        splats.push_back(random_splat(random, kX, kY, kTile));
        for (double& channel : splats.back().colour) {
            channel = static_cast<double>(random() % 1000) / 700;
        }
    }
    return splats;
}

} // namespace degs::test
