// SPDX-License-Identifier: Apache-2.0
// The energy of a frame without a simulation: the bill of materials and the constants of the cost
// model, with the work that the analytic model expects.
#pragma once

#include <cstdint>

#include "modules/kit/accelerator/render_engine.hpp"
#include "modules/kit/analytic/analytic_frame.hpp"

namespace degs {

/// `model` is that of the design, and `pixels` are those of the frame.
cost::RunEnergy estimated_energy(const AcceleratorConfig& config, const AnalyticModel& model,
                                 const AnalyticFrame& frame, std::uint64_t pixels);

} // namespace degs
