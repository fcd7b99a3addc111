// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "config/statistics_document.hpp"
#include "sim/run_config.hpp"

namespace degs::sim {

/// The statistics that runs of an accelerator may report, with units and meanings; what several
/// stages, buffers or streams have in common is listed once. Renders an empty frame to find out, so
/// that what is listed is what is collected: once per process. Throws std::logic_error if the model
/// breaks its laws.
std::vector<Statistic> statistics_of(const RunConfig& config);

} // namespace degs::sim
