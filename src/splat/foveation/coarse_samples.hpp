// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace degs {

/// The samples of a coarse row or column between which a pixel lies: two neighbours, or one twice
/// beside the border, which repeats the outermost.
struct CoarseSamples {
    int low = 0, high = 0;
    double share = 0; ///< of `high`
};

/// The ones around the centre of `pixel` >= 0. Each of `samples` >= 1 samples is the centre of
/// `scale` pixels.
inline CoarseSamples samples_at(int pixel, int scale, int samples) {
    const double at = (pixel + 0.5) / scale - 0.5;
    const double below = std::floor(at);
    const int low = static_cast<int>(below);
    return {std::clamp(low, 0, samples - 1), std::clamp(low + 1, 0, samples - 1), at - below};
}

} // namespace degs
