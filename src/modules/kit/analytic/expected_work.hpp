// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "modules/kit/accelerator/analytic_model.hpp"
#include "modules/kit/job/tile_order.hpp"
#include "splat/frame/tile_work.hpp"

namespace degs {

/// The work of every tile that lists a splat, in the order of rendering, as CoarseTile finds it.
/// With a model the clock of the design follows all of them, one after the other, and says how long
/// each takes.
std::vector<TileWork> expected_work(const FrameWorkload& frame, const AnalyticModel* model,
                                    TileOrder order = TileOrder::Raster);

} // namespace degs
