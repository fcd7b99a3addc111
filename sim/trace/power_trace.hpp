// SPDX-License-Identifier: Apache-2.0
// The power of a run over time, by block.
#pragma once

#include <string>
#include <vector>

#include "modules/kit/accelerator/accelerator_result.hpp"
#include "modules/kit/accelerator/render_engine.hpp"

namespace degs::sim {

/// The mean power of a block in each step of a timeline.
struct PowerSeries {
    std::string name; ///< as in the section `energy.blocks` of a report, or "memory"
    std::vector<double> mw;
};

/// Spreads the energies of a report over the steps of the run's timeline, so that each series
/// integrates to its energy: leakage over the time of the run, and what a block has done in
/// proportion to the work of the units that cause it. docs/timeline.md lists these units.
std::vector<PowerSeries> power_of(const AcceleratorConfig& config, const AcceleratorResult& run);

} // namespace degs::sim
