// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/projection_rate.hpp"

namespace degs {

void ProjectionRate::describe(ConfigVisitor& visitor) {
    visitor.integer("cycles_per_gaussian", cycles_per_gaussian, 1, 1024,
                    "cycles per Gaussian and unit, so that bandwidth limits [assumed]");
    visitor.integer("unscented_passes", unscented_passes, 1, 1024,
                    "of a Gaussian through a unit with pipeline.rules.projection: unscented, as "
                    "its 666 operations to the 167 of linear [assumed]");
}

} // namespace degs
