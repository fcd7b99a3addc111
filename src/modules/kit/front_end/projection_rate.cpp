// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/projection_rate.hpp"

namespace degs {

void ProjectionRate::describe(ConfigVisitor& visitor) {
    visitor.integer("cycles_per_gaussian", cycles_per_gaussian, 1, 1024,
                    "cycles per Gaussian and unit, so that bandwidth limits [assumed]");
    visitor.integer("unscented_passes", unscented_passes, 1, 1024,
                    "of a Gaussian through a unit with pipeline.rules.projection: unscented, as "
                    "its 666 operations to the 167 of linear [assumed]");
    visitor.real("unscented_operations", unscented_operations, 1, 1024,
                 "of a Gaussian, relative to linear: 666 / 167; area and power of a unit are those "
                 "of this / unscented_passes linear ones, 1 at least [assumed]");
}

} // namespace degs
