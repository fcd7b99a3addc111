// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/cache/cached_view.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/run/run_plan.hpp"

namespace degs::sim {

/// Makes or finds the frames of the view, runs them as the plan says and compares the images of the
/// first one with their references. `since_start` has run since the command began.
RunResult simulate(const RunPlan& plan, CachedView& view, const Stopwatch& since_start);

} // namespace degs::sim
