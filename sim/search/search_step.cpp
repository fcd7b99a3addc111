// SPDX-License-Identifier: Apache-2.0
#include "sim/search/search_step.hpp"

#include <algorithm>
#include <limits>

#include "config/config_words.hpp"
#include "degs/error.hpp"

namespace degs::sim {

double excess_of(const DesignVerdict& verdict) {
    return verdict.broken.empty() ? 0
                                  : std::max(verdict.excess, std::numeric_limits<double>::min());
}

std::vector<std::size_t> kept_variants(const StudyPlan& plan) {
    std::vector<std::size_t> kept{plan.baseline};
    for (const std::string& name : designs_in(plan.aims)) {
        const auto found =
            std::find_if(plan.variants.begin(), plan.variants.end(),
                         [&name](const StudyVariant& variant) { return variant.name == name; });
        if (found == plan.variants.end()) {
            std::vector<std::string> names;
            for (const StudyVariant& variant : plan.variants) {
                names.push_back(variant.name);
            }
            const std::string near = config_words::nearest(name, names);
            throw InputError("A limit compares with " + config_words::quote(name) +
                             ", but no point of the study has this name" +
                             (near.empty() ? "; a design has it where every key has the value of "
                                             "its own file."
                                           : "; it may mean " + config_words::quote(near) + "."));
        }
        kept.push_back(static_cast<std::size_t>(found - plan.variants.begin()));
    }
    return kept;
}

} // namespace degs::sim
