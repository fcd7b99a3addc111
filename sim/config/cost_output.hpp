// SPDX-License-Identifier: Apache-2.0
// What a design costs, for `degs config --cost`.
#pragma once

#include <string>

#include "cost/bill_of_materials.hpp"
#include "cost/clock_limits.hpp"

namespace degs::sim {

/// A table for terminals: a line for each block, then the sums, and the clock.
std::string cost_text(const cost::BillOfMaterials& bill, const cost::ClockEstimate& clock);
/// The lines and sums of cost_text() as a Markdown table.
std::string cost_markdown(const cost::BillOfMaterials& bill);
/// `name`, and `area` and `clock`, the sections of that name in a report.
std::string cost_json(const std::string& name, const cost::BillOfMaterials& bill,
                      const cost::ClockEstimate& clock);

} // namespace degs::sim
