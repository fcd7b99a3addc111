// SPDX-License-Identifier: Apache-2.0
#include "sim/analytic/what_if_run.hpp"

#include <map>

#include "config/config_source.hpp"
#include "sim/analytic/analytic_run.hpp"
#include "sim/report/losses.hpp"
#include "sim/text/comma_parts.hpp"
#include "sim/view/frame_kind.hpp"

namespace degs::sim {
namespace {

double estimated_cycles(const RunConfig& config, const FrameWorkload& frame) {
    return estimate_frame(*analytic_model_of(config), frame, config.accelerator().tile_order)
        .cycles;
}

} // namespace

std::vector<ChangedDesign> changed_designs(const RunConfig& config,
                                           const std::vector<std::string>& changes) {
    std::vector<ChangedDesign> designs;
    for (const std::string& change : changes) {
        ChangedDesign design{change, config};
        ConfigSource::from_overrides(comma_parts(change), "--what-if").load(design.config);
        analytic_model_of(design.config);
        designs.push_back(std::move(design));
    }
    return designs;
}

std::vector<WhatIf> what_if(const RunConfig& config, const std::vector<ChangedDesign>& changed,
                            const FrameWorkload& frame, CachedView& view) {
    std::vector<WhatIf> list;
    if (changed.empty()) {
        return list;
    }
    const SceneTraits traits = view.facts().traits;
    const FrameKind own = frame_kind(config.accelerator(), traits);
    std::map<FrameKind, FramePointer> others;
    const double before = estimated_cycles(config, frame);
    for (const ChangedDesign& design : changed) {
        const AcceleratorConfig& accelerator = design.config.accelerator();
        const FrameKind kind = frame_kind(accelerator, traits);
        if (kind != own && others.count(kind) == 0) {
            others.emplace(kind, view.first_frame(accelerator).front());
        }
        list.push_back({design.change, before,
                        estimated_cycles(design.config, kind == own ? frame : *others.at(kind))});
    }
    return list;
}

std::vector<WhatIf> gains(const RunResult& result, const FrameWorkload& frame, CachedView& view) {
    if (result.accelerator.array_only || result.config.accelerator().analytic() == nullptr) {
        return {};
    }
    return what_if(result.config, changed_designs(result.config, named_changes(result)), frame,
                   view);
}

} // namespace degs::sim
