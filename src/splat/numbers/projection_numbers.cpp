// SPDX-License-Identifier: Apache-2.0
#include "splat/numbers/projection_numbers.hpp"

namespace degs {

std::string ProjectionNumbers::name() const {
    const ProjectionNumbers reference;
    std::string name = format.name();
    if (sh_dc != reference.sh_dc || sh_rest != reference.sh_rest) {
        name += ", SH " + sh_dc.name() + " and " + sh_rest.name();
    }
    if (depth_key != reference.depth_key) {
        name += ", depth keys " + depth_key.name();
    }
    return name;
}

} // namespace degs
