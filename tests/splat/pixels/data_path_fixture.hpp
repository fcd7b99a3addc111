// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "splat/pixels/data_path.hpp"
#include "tests/splat/frame/projected.hpp"

/// Data paths that hold splats made by hand.
namespace degs::test {

inline FrameWorkload frame_of(const std::vector<ProjectedSplat>& splats) {
    FrameWorkload frame;
    frame.splats = splats;
    return frame;
}

inline void begin_tile(DataPath& path, int context, int tile_size) {
    for (int row = 0; row < tile_size; ++row) {
        path.begin_row(context, row);
    }
}

inline std::unique_ptr<DataPath> path_of(const std::vector<ProjectedSplat>& splats,
                                         const DataPathOptions& options, int tile_size = 64,
                                         int contexts = 1) {
    auto path = make_data_path(options, tile_size, contexts);
    EXPECT_EQ(path->add_frame(frame_of(splats)), 0U);
    for (int c = 0; c < contexts; ++c) {
        begin_tile(*path, c, tile_size);
    }
    return path;
}

inline DataPathOptions path_options(Arithmetic numbers, SpanEnds ends = SpanEnds::Exact,
                                    int delta = 0) {
    DataPathOptions o;
    o.numbers = numbers;
    o.ends = ends;
    o.delta = delta;
    return o;
}

} // namespace degs::test
