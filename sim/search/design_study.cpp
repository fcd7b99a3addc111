// SPDX-License-Identifier: Apache-2.0
#include "sim/search/design_study.hpp"

#include "degs/error.hpp"
#include "scene/scene.hpp"
#include "sim/study/addressed_overrides.hpp"

namespace degs::sim {

Study study_of_designs(Study study, const std::string& file, const std::string& command) {
    if (!study.axes.empty()) {
        throw InputError(file + " has axes, but '" + command +
                         "' varies designs by axes of its own; 'degs sweep' runs a study.");
    }
    study.reference = false;
    study.goals = {"latency_ms", command};
    study.limits = {};
    study.baseline.clear();
    return study;
}

RunConfig first_design(const Study& study) {
    const StudyDesign& design = study.designs.front();
    return load_run_config(
        ConfigSource::from_tree(design.tree, overrides_of(design.name, study.overrides)));
}

std::string words_of(const StudyPlan& plan, const StudyView& view) {
    const ImageSize& size = plan.request.sizes[view.size];
    std::string words =
        scene_name(plan.request.scenes[view.scene]) + " · camera " + std::to_string(view.camera);
    if (size.width && size.height) {
        words += " · " + std::to_string(*size.width) + "×" + std::to_string(*size.height);
    } else if (size.width) {
        words += " · " + std::to_string(*size.width) + " px wide";
    } else if (size.height) {
        words += " · " + std::to_string(*size.height) + " px high";
    }
    return words;
}

} // namespace degs::sim
