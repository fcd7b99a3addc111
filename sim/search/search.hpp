// SPDX-License-Identifier: Apache-2.0
// Runs of a search, step by step.
#pragma once

#include <optional>
#include <string>

#include "sim/process/failure.hpp"
#include "sim/search/search_part.hpp"
#include "sim/search/search_step.hpp"
#include "sim/sweep/study_plan.hpp"

namespace degs::sim {

/// What is searched for, if nobody says anything else.
constexpr const char* kUsualGoals = "area_mm2,latency_ms";

/// Throws InputError for goals and limits that runs of this plan do not have.
void check_aims(const StudyPlan& plan);

/// Runs what the steps ask for in the folder `out` and below it, or the part of it that is this
/// process's; an interrupted search goes on there, because the same steps find their results.
/// False after Ctrl-C. Throws InputError if a design does not have what the goals and limits need,
/// and FailureError if other parts do not come.
bool search(const StudyPlan& plan, SearchSteps& steps, SearchPart& part, const std::string& out,
            std::optional<Failure>& failure);

} // namespace degs::sim
