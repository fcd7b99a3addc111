// SPDX-License-Identifier: Apache-2.0
#include "sim/run/run_simulation.hpp"

#include <utility>

#include "sim/process/memory_use.hpp"
#include "sim/simulation/completed_run.hpp"

namespace degs::sim {

RunResult simulate(const RunPlan& plan, CachedView& view, const Stopwatch& since_start) {
    const Stopwatch wall;
    const RunRequest& request = plan.request;
    const AcceleratorConfig& design = request.config.accelerator();
    const bool judged = request.reference && !request.sampling;
    const std::vector<FramePointer> first = view.first_frame(design);
    if (judged) {
        view.require_reference(*first.front());
    }
    std::vector<WhatIf> worth = what_if(request.config, plan.changed, *first.front(), view);
    References references;
    if (judged && view.references_need_cloud(*first.front())) {
        references = view.references(first);
    }
    RunResult result = run_frames(request, view.frames(design, first));
    put_scene(view.facts(), result);
    result.what_if = std::move(worth);
    result.gains = gains(result, *first.front(), view);
    if (view.foveated()) {
        put_foveation(*view.foveated(), result);
    }
    if (request.reference && !result.sampling) { // most of a sample's image is missing
        if (references.views.empty()) {
            references = view.references(first);
        }
        judge(result, references);
    }
    result.host.load_s = view.load_s();
    result.host.start_s = since_start.seconds_to(result.accelerator.sim_start);
    result.host.workload_s = view.workload_s();
    result.host.wall_s = view.load_s() + wall.seconds();
    result.host.peak_rss_bytes = peak_rss_bytes();
    view.keep(first, references.views);
    return result;
}

} // namespace degs::sim
