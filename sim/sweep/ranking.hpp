// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/goals/goals.hpp"
#include "sim/sweep/study_plan.hpp"
#include "sim/sweep/sweep_results.hpp"

namespace degs::sim {

/// A table of the `most` best designs of a study, over all views: by the first goal, equal ones by
/// the next. Designs that break a limit of the study come behind the others, and those that lack a
/// goal or a view are left out, which a line says.
std::string ranking_text(const StudyPlan& plan, const SweepResults& results,
                         const std::vector<Aim>& goals, std::size_t most);

} // namespace degs::sim
