// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <vector>

#include "tests/modules/degs/workload_fixture.hpp"

namespace degs::test {

/// Random splats of 3 to 12 px with colours below 1, as trained scenes have them.
inline FrameWorkload soft_frame(unsigned seed, int count, int width, int height, int tile_size) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < count; ++i) {
        splats.push_back(make_splat(width * unit(random), height * unit(random),
                                    1 + 8 * unit(random), 0.8 + 3 * unit(random),
                                    6.3 * unit(random), 0.05 + 0.9 * unit(random)));
        for (double& channel : splats.back().colour) {
            channel = unit(random);
        }
    }
    return make_frame(splats, width, height, tile_size);
}

} // namespace degs::test
