// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/kit/accelerator/analytic_model.hpp"
#include "modules/kit/job/tile_order.hpp"

namespace degs {

/// Cycles between which a simulation lies on nine views in ten.
struct CycleInterval {
    double low = 0, high = 0;
};
constexpr double kEstimateConfidence = 0.9;

/// The time of a frame, bounded and estimated.
struct AnalyticFrame {
    double cycles = 0;      ///< the estimate
    double preparation = 0; ///< of it, until the lists are complete
    double lower = 0;       ///< with these units and rates (of LPDDR5: the expected one) at least
    double upper = 0;       ///< if no two kinds of units worked at the same time
    double utilization = 0; ///< fragments over PEs x blending cycles
    double bytes = 0;       ///< moved to and from memory
    double written = 0;     ///< of them, the bytes to memory
    struct Unit {
        std::string name;
        double preparing = 0, rendering = 0; ///< cycles
    };
    std::vector<Unit> units;
    std::string limited_by; ///< the unit that is busy longest while tiles are rendered
    std::vector<cost::Activity> activity; ///< of every block in the bill of materials
    std::size_t tiles = 0;                ///< that list a splat
    std::size_t drawn = 0;                ///< of them, the tiles that the estimate rests on
    int rows_apart = 1;                   ///< one block of their rows in so many
    double carrying_tiles = 0; ///< tiles of equal times that would scatter as the tiles do
    double drawing_error =
        0;              ///< standard error of the cycles, relative to them, from drawing tiles
    double busiest = 0; ///< share of the rendering cycles that `limited_by` is busy
    std::optional<CycleInterval> interval; ///< of the cycles; empty if the model was not measured
};

/// Renders a sample of the tiles coarsely, see CoarseTile, which takes some milliseconds on any
/// frame.
AnalyticFrame estimate_frame(const AnalyticModel& model, const FrameWorkload& frame,
                             TileOrder order = TileOrder::Raster);

} // namespace degs
