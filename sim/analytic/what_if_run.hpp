// SPDX-License-Identifier: Apache-2.0
// degs run --what-if: what changes of a design would be worth, by the analytic model.
#pragma once

#include <string>
#include <vector>

#include "sim/cache/cached_view.hpp"
#include "sim/design/run_config.hpp"
#include "sim/simulation/run_result.hpp"

namespace degs::sim {

/// A design after a change.
struct ChangedDesign {
    std::string change;
    RunConfig config;
};

/// Each change is "KEY=VALUE" or several of these separated by commas. Throws InputError for
/// mistakes as --set does, and if the accelerator has no analytic model although there is a change.
std::vector<ChangedDesign> changed_designs(const RunConfig& config,
                                           const std::vector<std::string>& changes);

/// The changes on the view, whose `frame` was made for the design before them. It is shared by all
/// changes that leave tiles and projection as they are.
std::vector<WhatIf> what_if(const RunConfig& config, const std::vector<ChangedDesign>& changed,
                            const FrameWorkload& frame, CachedView& view);

/// What the changes that the largest losses of a run name would gain on the view; empty if the
/// accelerator has no analytic model, or if the run was of its array alone.
std::vector<WhatIf> gains(const RunResult& result, const FrameWorkload& frame, CachedView& view);

} // namespace degs::sim
