// SPDX-License-Identifier: Apache-2.0
#include "sim/run/run_view.hpp"

#include "sim/cache/kept_views.hpp"
#include "sim/run/run_options.hpp"

namespace degs::sim {

namespace {

bool view_was_missed = false;

} // namespace

std::shared_ptr<CachedView> view_of(const RunPlan& plan) {
    std::shared_ptr<CachedView> view =
        plan.cached ? KeptViews::of_process().find(plan.view, plan.path) : nullptr;
    view_was_missed =
        plan.cached && KeptViews::keeps(plan.view, plan.path) &&
        (view == nullptr || !view->holds_first_frame(plan.request.config.accelerator()));
    return view != nullptr
               ? view
               : std::make_shared<CachedView>(plan.view, plan.path,
                                              plan.cached ? FrameCache::of_user() : FrameCache());
}

bool missed_view() {
    return view_was_missed;
}

void keep_view_of(const std::vector<std::string>& arguments) {
    const std::optional<RunOptions> options = run_options_of(arguments);
    if (!options || options->no_cache || !KeptViews::keeps(options->view, options->path)) {
        return;
    }
    const RunPlan plan = plan_of(*options);
    KeptViews::of_process().keep(plan.view, plan.path, plan.request.config.accelerator());
}

} // namespace degs::sim
