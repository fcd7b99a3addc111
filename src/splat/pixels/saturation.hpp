// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "splat/pixels/data_path.hpp"

namespace degs {

/// A field of the splat record whose format does not reach far enough for a frame.
struct Saturation {
    std::string stage;        ///< as in pipeline.formats
    std::string format;       ///< name of the format
    double limit = 0;         ///< largest value of the format
    std::uint64_t splats = 0; ///< of the frame, whose value lies beyond
};

/// The stages at which splats of `frame` leave the range of their number format when their records
/// are made; empty for fp32 and fp64. 1 / r_y^2 counts only where the ellipse is at least a pixel
/// high: below, it says no more than that the splat covers a single row.
std::vector<Saturation> saturated_stages(const DataPathOptions& options,
                                         const FrameWorkload& frame);

} // namespace degs
