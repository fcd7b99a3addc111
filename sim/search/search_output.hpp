// SPDX-License-Identifier: Apache-2.0
// The results of a search for people and programs.
#pragma once

#include <string>
#include <vector>

#include "sim/search/search_step.hpp"
#include "sim/shell/output_folder.hpp"

namespace degs::sim {

/// Raised whenever a key of explore.json changes its meaning, name or unit.
constexpr int kExploreVersion = 1;

/// Writes search_files(): the results, and how the search came to them; beliefs.csv only of a
/// search that believed something.
void write_search(const StudyPlan& plan, const Search& search, const OutputFolder& folder);

/// The front as a table, and how well the estimates ranked the designs.
std::string search_text(const StudyPlan& plan, const Search& search);

} // namespace degs::sim
