// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "splat/frame/frame_workload.hpp"
#include "splat/frame/tile_window.hpp"
#include "splat/images/image.hpp"

namespace degs {

/// Counters of a reference render.
struct ReferenceCounts {
    std::uint64_t fragments = 0;  ///< pixel updates performed
    std::uint64_t terminated = 0; ///< pixels that stopped early (a splat was refused)
};

/// Renders a workload on all processors, in double precision with the pixel rules of the original
/// rasteriser: alpha = min(0.99, o exp(-q/2)), skipped if alpha < 1/255, the splat that would push
/// the transmittance under 1e-4 is refused and ends the pixel. Background is black (0). It tests
/// the alpha of every candidate pixel itself and shares no span arithmetic with the data path. The
/// alpha threshold is workload.projection.alpha_min (1/255). With TileMode::Exact the image does
/// not depend on the tile size.
Image render_reference(const FrameWorkload& workload, ReferenceCounts& counts);
/// The pixels of a window's tiles alone; the image has their size.
Image render_reference(const FrameWorkload& workload, ReferenceCounts& counts,
                       const TileWindow& window);

} // namespace degs
