// SPDX-License-Identifier: Apache-2.0
// Number sets as `degs accuracy` names them, and the data path that computes in them.
#pragma once

#include <string>
#include <vector>

#include "splat/data_path.hpp"

namespace degs::sim {

/// "exact", "outward", "slope", in the order of SpanEnds.
std::vector<std::string> span_end_names();
std::string words_of(SpanEnds ends);

/// A named set with the span ends of that name; with its own if the name is empty. InputError lists
/// the names for any other.
NumberSet numbers_of(const std::string& name, const std::string& span_ends);

/// The data path that a run has for a named set, with the set's ends and the reference's stop rule.
DataPathOptions data_path_of(const NumberSet& set);

} // namespace degs::sim
