// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/cache/cached_view.hpp"

namespace degs::sim_test {

/// Copies of all frames of a path.
inline std::vector<FrameWorkload> all_frames(sim::CachedView& view,
                                             const AcceleratorConfig& config) {
    const std::vector<FramePointer> first = view.first_frame(config);
    FrameSource source = view.frames(config, first);
    std::vector<FrameWorkload> all;
    while (const FramePointer frame = source.take()) {
        all.push_back(*frame);
    }
    return all;
}

} // namespace degs::sim_test
