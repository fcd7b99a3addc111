// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/study_variants.hpp"

#include <algorithm>

#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "sim/sweep/design_space.hpp"

namespace degs::sim {
void plan_variants(const Study& study, StudyPlan& plan) {
    DesignSpace space(study, plan);
    const bool coincide = // points that are the same count once
        study.one_at_a_time || std::any_of(study.axes.begin(), study.axes.end(),
                                           [](const Axis& axis) { return axis.random; });
    for (const Genes& place : space.places()) {
        const DesignSpace::Added added = space.add(place);
        if (!added.is_new && !coincide) {
            throw InputError("The study has the point " + config_words::quote(added.name) +
                             " twice; a value of an axis is given twice.");
        }
    }
    if (plan.variants.empty()) {
        throw InputError("No point of the study can be built; the first one: " +
                         plan.skipped.front().why);
    }
    space.add_baseline();
}

} // namespace degs::sim
