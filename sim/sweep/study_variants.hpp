// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/sweep/study_plan.hpp"

namespace degs::sim {

/// Expands the designs and axes of a study into the variants of a plan, with a configuration for
/// each, those that cannot be built, and the baseline. Throws InputError like plan_study().
void plan_variants(const Study& study, StudyPlan& plan);

} // namespace degs::sim
