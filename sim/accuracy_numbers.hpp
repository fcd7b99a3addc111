// SPDX-License-Identifier: Apache-2.0
// Number sets as `degs accuracy` names them, and the data path that computes in them.
#pragma once

#include <string>
#include <vector>

#include "splat/data_path.hpp"
#include "splat/number_set.hpp"

namespace degs::sim {

/// "exact", "outward", as in the row of a result.
std::string words_of(Ends ends);
/// The names of words_of that a command takes.
std::vector<std::string> span_end_names();

/// A named set with the span ends of that name; with its own if the name is empty. InputError lists
/// the names for any other.
NumberSet numbers_of(const std::string& name, const std::string& span_ends);

/// The data path of a set, with the reference's stop rule. InputError if it cannot compute in it.
DataPathOptions data_path_of(const NumberSet& set);

} // namespace degs::sim
