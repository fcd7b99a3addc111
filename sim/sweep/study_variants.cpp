// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/study_variants.hpp"

#include <algorithm>

#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "sim/sweep/design_space.hpp"

namespace degs::sim {
namespace {

using config_words::quote;

/// Adds the designs of a study at places one after the other.
class Listing {
public:
    Listing(const Study& study, DesignSpace& space)
        : space_(space), coincide_(study.one_at_a_time ||
                                   std::any_of(study.axes.begin(), study.axes.end(),
                                               [](const Axis& axis) { return axis.random; })) {}

    /// Every combination, the last axis fastest.
    void add_all(std::size_t design) {
        Genes place(space_.genes().size(), 0);
        place.front() = design;
        do {
            add(place);
        } while (advance(place));
    }

    void add_one_at_a_time(std::size_t design) {
        Genes place(space_.genes().size(), DesignSpace::kOwn);
        place.front() = design;
        add(place);
        for (std::size_t a = 1; a < place.size(); ++a) {
            for (place[a] = 0; place[a] < space_.genes()[a].positions; ++place[a]) {
                add(place);
            }
            place[a] = DesignSpace::kOwn;
        }
    }

private:
    void add(const Genes& place) {
        const DesignSpace::Added added = space_.add(place);
        if (!added.is_new && !coincide_) {
            throw InputError("The study has the point " + quote(added.name) +
                             " twice; a value of an axis is given twice.");
        }
    }

    /// The next combination of a design; false after the last one.
    bool advance(Genes& place) const {
        for (std::size_t a = place.size(); a-- > 1;) {
            if (++place[a] < space_.genes()[a].positions) {
                return true;
            }
            place[a] = 0;
        }
        return false;
    }

    DesignSpace& space_;
    bool coincide_; ///< points that are the same count once
};

} // namespace

void plan_variants(const Study& study, StudyPlan& plan) {
    DesignSpace space(study, plan);
    Listing listing(study, space);
    for (std::size_t design = 0; design < study.designs.size(); ++design) {
        if (study.one_at_a_time) {
            listing.add_one_at_a_time(design);
        } else {
            listing.add_all(design);
        }
    }
    if (plan.variants.empty()) {
        throw InputError("No point of the study can be built; the first one: " +
                         plan.skipped.front().why);
    }
    space.add_baseline();
}

} // namespace degs::sim
