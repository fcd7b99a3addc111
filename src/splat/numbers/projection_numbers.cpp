// SPDX-License-Identifier: Apache-2.0
#include "splat/numbers/projection_numbers.hpp"

namespace degs {
namespace {

/// Scenes hold single precision.
int stored_bits(const NumberFormat& format) {
    constexpr int kBitsInScenes = 32;
    return format.is_fp64() ? kBitsInScenes : format.storage_bits();
}

} // namespace

bool ProjectionNumbers::keeps_gaussians() const {
    return mean.is_fp64() && scale.is_fp64() && rotation.is_fp64() && opacity.is_fp64() &&
           sh_dc.is_fp64() && sh_rest.is_fp64();
}

int ProjectionNumbers::mean_bits() const {
    return 3 * stored_bits(mean);
}

int ProjectionNumbers::shape_bits() const {
    return 3 * stored_bits(scale) + 4 * stored_bits(rotation) + stored_bits(opacity);
}

int ProjectionNumbers::sh_bits(int degree) const {
    const int rest = (degree + 1) * (degree + 1) - 1;
    return 3 * (stored_bits(sh_dc) + rest * stored_bits(sh_rest));
}

std::string ProjectionNumbers::name() const {
    const ProjectionNumbers reference;
    std::string name = format.name();
    const auto add = [&name](const char* what, const NumberFormat& mine,
                             const NumberFormat& usual) {
        if (mine != usual) {
            name += std::string(", ") + what + " " + mine.name();
        }
    };
    add("means", mean, reference.mean);
    add("scales", scale, reference.scale);
    add("rotations", rotation, reference.rotation);
    add("opacities", opacity, reference.opacity);
    if (sh_dc != reference.sh_dc || sh_rest != reference.sh_rest) {
        name += ", SH " + sh_dc.name() + " and " + sh_rest.name();
    }
    add("depth keys", depth_key, reference.depth_key);
    return name;
}

bool ProjectionNumbers::operator==(const ProjectionNumbers& other) const {
    return format == other.format && mean == other.mean && scale == other.scale &&
           rotation == other.rotation && opacity == other.opacity && sh_dc == other.sh_dc &&
           sh_rest == other.sh_rest && depth_key == other.depth_key;
}

} // namespace degs
