// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/cache/cached_view.hpp"
#include "sim/run/run_plan.hpp"

namespace degs::sim {

/// The view of a run: the one that this process keeps, or a new one. Throws InputError for mistakes
/// in the view, its scene and its cameras.
std::shared_ptr<CachedView> view_of(const RunPlan& plan);

/// Whether view_of() has been asked for a view that could be kept, and was not or without the frame
/// of the run.
bool missed_view();

/// For a server, one of whose forks has run the command with these arguments: keeps its view for
/// the forks to come, if the command is `degs run` of one view.
void keep_view_of(const std::vector<std::string>& arguments);

} // namespace degs::sim
