// SPDX-License-Identifier: Apache-2.0
// What a run has to do, from its options: the design is read and checked, no scene is there yet.
#pragma once

#include <vector>

#include "sim/analytic/what_if_run.hpp"
#include "sim/run/run_options.hpp"
#include "sim/simulation/simulation.hpp"

namespace degs::sim {

struct RunPlan {
    bool analytic = false;              ///< an estimate in place of a simulation
    RunRequest request;                 ///< without what follows from the view and the files
    std::vector<ChangedDesign> changed; ///< by --what-if
    ViewRequest view;
    PathRequest path;
    bool cached = true; ///< frames and references of earlier runs are used and kept
};

/// Throws InputError.
RunPlan plan_of(const RunOptions& options);

} // namespace degs::sim
