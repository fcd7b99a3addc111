// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/degs.hpp"
#include "sim/accelerator_run.hpp"

namespace degs::sim {

/// Elaborates DeGS, runs the kernel until every tile is in memory, collects the results.
AcceleratorResult run_degs(const DegsConfig& config, const FrameWorkload& workload,
                           Fidelity fidelity, Progress& progress);

/// Tiles whose pixels have all been read out.
std::uint64_t finished_tiles(const Degs& degs);

/// Reads the counters of a finished DeGS into `result`; images and host times are not its matter.
void collect_degs(const Degs& degs, AcceleratorResult& result);

} // namespace degs::sim
