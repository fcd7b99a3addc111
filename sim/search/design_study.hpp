// SPDX-License-Identifier: Apache-2.0
// Studies of commands that vary designs by axes of their own.
#pragma once

#include <string>

#include "sim/study/study_file.hpp"
#include "sim/sweep/study_plan.hpp"

namespace degs::sim {

/// The designs and views of a study that was read from `file`, without its own goals, limits,
/// baseline and reference images. Throws InputError, which names the command, if it has axes.
Study study_of_designs(Study study, const std::string& file, const std::string& command);

/// The first design as it loads, with what the options set.
RunConfig first_design(const Study& study);

/// "flowers · camera 2 · 1080 px high".
std::string words_of(const StudyPlan& plan, const StudyView& view);

} // namespace degs::sim
