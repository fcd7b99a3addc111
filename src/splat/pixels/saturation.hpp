// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "splat/pixels/data_path.hpp"

namespace degs {

/// A number of the data path whose format does not reach far enough for a frame.
struct Saturation {
    std::string stage;        ///< the part of NumberSet::describe
    std::string format;       ///< name of the format
    double limit = 0;         ///< largest value of the format
    std::uint64_t splats = 0; ///< of the frame, whose value lies beyond; of `sum` pixels
};

/// The stages at which splats of `frame` leave the range of their number format when their records
/// are made, and, of splats whose records are right, those behind where their largest value in the
/// image does; empty for fp32 and fp64. 1 / r_y^2 counts only where the ellipse is at least a pixel
/// high: below, it says no more than that the splat covers a single row. A weight is that of a
/// splat that nothing covers.
std::vector<Saturation> saturated_stages(const DataPathOptions& options,
                                         const FrameWorkload& frame);

/// Where accumulated colours end; no pixel is counted. None for fp32 and fp64.
std::optional<Saturation> end_of_sums(const DataPathOptions& options);

} // namespace degs
