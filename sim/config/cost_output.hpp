// SPDX-License-Identifier: Apache-2.0
// What a design costs, for `degs config --cost`.
#pragma once

#include <string>

#include "cost/bill_of_materials.hpp"

namespace degs::sim {

/// A table for terminals: a line for each block, then the sums.
std::string cost_text(const cost::BillOfMaterials& bill);
/// The lines and sums of cost_text() as a Markdown table.
std::string cost_markdown(const cost::BillOfMaterials& bill);
/// `name` and `area`, the section of that name in a report.
std::string cost_json(const std::string& name, const cost::BillOfMaterials& bill);

} // namespace degs::sim
