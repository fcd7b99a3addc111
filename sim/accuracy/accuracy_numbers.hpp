// SPDX-License-Identifier: Apache-2.0
// Number sets as `degs accuracy` names them, and the data path that computes in them.
#pragma once

#include <string>
#include <vector>

#include "splat/pixels/data_path.hpp"

namespace degs::sim {

/// "exact", "outward", "slope", in the order of SpanEnds.
std::vector<std::string> span_end_names();
std::string words_of(SpanEnds ends);

/// A set, and the data path that a run has for it: with the set's ends and projection and the
/// reference's stop rule.
struct AccuracyNumbers {
    NumberSet set;
    DataPathOptions path;
};

/// What read_numbers() makes of the text, "tuned:projection=fp64:alpha=uq1.15" or a number file,
/// with the span ends of that name; with the set's own if it is empty. The set is called as the
/// text is, with spaces. Throws InputError with the mistake and the allowed names.
AccuracyNumbers numbers_of(const std::string& text, const std::string& span_ends);

/// Options with which the frames of a set are projected; a hard case has its own near plane.
ProjectionOptions projected_in(const NumberSet& set, ProjectionOptions options = {});

} // namespace degs::sim
