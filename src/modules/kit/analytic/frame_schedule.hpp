// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "modules/kit/accelerator/analytic_model.hpp"

namespace degs {

/// A tile in the order in which the design takes them.
struct ScheduledTile {
    double entries = 0;
    TileCycles cycles; ///< of the tile, or scaled from one like it
};

/// The cycles from complete lists to the end of the last tile: every tile waits for its list, for
/// its splats and for an engine, and no kind of unit does more than it can.
/// `used`: cycles that units spend on what belongs to no tile of the list.
double schedule(const AnalyticModel& model, const std::vector<ScheduledTile>& tiles,
                UnitCycles used);

} // namespace degs
