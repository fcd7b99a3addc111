// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "modules/kit/accelerator/render_engine.hpp"

namespace degs {

/// The energy of a run whose counters have been collected; `pixels`: of all frames. Throws
/// std::logic_error if a block of the bill of materials reports no activity.
cost::RunEnergy energy_of(const AcceleratorConfig& config, const AcceleratorResult& result,
                          std::uint64_t pixels);

/// The energy of a plain bus that moves so many bytes in `seconds`; `gb_per_s` is its peak.
double bus_nj(const cost::Technology::Dram& dram, double bytes_read, double bytes_written,
              double gb_per_s, double seconds);

} // namespace degs
