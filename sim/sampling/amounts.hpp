// SPDX-License-Identifier: Apache-2.0
// The counters of a result as one list of numbers, and back.
#pragma once

#include <vector>

#include "modules/kit/accelerator/accelerator_result.hpp"

namespace degs::sim {

/// What adds up over tiles: work of stages, traffic, events. Dates, slots and shares are not in it.
/// Every result of one engine gives the same amounts in the same order.
std::vector<double> amounts_of(const AcceleratorResult& result);

/// `shape` with other amounts; its cycles and its memory window must be those that shares shall
/// refer to. Whole numbers are rounded; peaks are not changed. What follows from the amounts (busy
/// shares, utilisation of the memory) is worked out again; the energy is not.
AcceleratorResult with_amounts(AcceleratorResult shape, const std::vector<double>& amounts);

} // namespace degs::sim
