// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "splat/pixels/data_path.hpp"

namespace degs {

/// The difference between the spans of two data paths on a frame, with every row of a splat solved
/// for the whole width of the image.
struct SpanDifference {
    std::uint64_t spans = 0;  ///< of the first
    std::uint64_t pixels = 0; ///< in them
    std::uint64_t flips = 0;  ///< pixels that only one of the two has
    double farthest = 0;      ///< largest |255 alpha - 1| of a flip: 0 on the ellipse
    bool inside = true;       ///< no span of either leaves the image
};

/// The image is at most 32 767 px wide.
SpanDifference compare_spans(const FrameWorkload& workload, const DataPathOptions& first,
                             const DataPathOptions& second);

} // namespace degs
