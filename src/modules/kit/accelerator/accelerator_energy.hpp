// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/kit/accelerator/render_engine.hpp"

namespace degs {

/// The energy of a run whose counters have been collected; `pixels`: of all frames. Throws
/// std::logic_error if a block of the bill of materials reports no activity.
cost::RunEnergy energy_of(const AcceleratorConfig& config, const AcceleratorResult& result,
                          std::uint64_t pixels);

} // namespace degs
