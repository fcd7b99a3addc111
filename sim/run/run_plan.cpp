// SPDX-License-Identifier: Apache-2.0
#include "sim/run/run_plan.hpp"

namespace degs::sim {

RunPlan plan_of(const RunOptions& options) {
    RunPlan plan;
    plan.analytic = options.fidelity == "analytic";
    RunRequest& request = plan.request;
    if (!plan.analytic) {
        request.sampling = sampling_of(options.fidelity, options.within, options.seed);
    }
    request.config = load_run_config(options.config, options.overrides, options.memory);
    plan.changed = changed_designs(request.config, options.what_if);
    plan.view = options.view;
    plan.path = options.path;
    plan.path.near_plane = request.config.accelerator().data_path().rules.near;
    plan.cached = !options.no_cache;
    const bool strict = options.fidelity == "strict" || options.files.block_log.given();
    request.fidelity = strict ? Fidelity::Strict : Fidelity::Exact;
    request.build.array_only = options.array_only;
    request.reference = !options.no_reference;
    return plan;
}

} // namespace degs::sim
