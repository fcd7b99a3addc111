// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/design/run_config.hpp"
#include "stats/statistics_document.hpp"

namespace degs::sim {

/// The statistics that runs of an accelerator may report, with units and meanings; what several
/// stages, buffers or streams have in common is listed once. It renders an empty frame, so that the
/// list contains exactly what a run collects; it can be called once per process. Throws
/// std::logic_error if the model breaks its invariants.
std::vector<Statistic> statistics_of(const RunConfig& config);
/// The keys of a run of compare.json, which are columns of compare.csv. Renders likewise.
std::vector<Statistic> statistics_of_compare();
/// The numbers of memory.json.
std::vector<Statistic> statistics_of_memory();

} // namespace degs::sim
