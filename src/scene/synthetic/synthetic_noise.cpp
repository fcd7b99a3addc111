// SPDX-License-Identifier: Apache-2.0
#include "scene/synthetic/synthetic_noise.hpp"

#include <cmath>
#include <cstdint>

namespace degs {
namespace {

/// A number in [0, 1) for a point of the lattice: the finaliser of SplitMix64 over its coordinates.
double at_point(std::int64_t x, std::int64_t y, std::int64_t z) {
    std::uint64_t bits = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15U ^
                         static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FU ^
                         static_cast<std::uint64_t>(z) * 0x165667B19E3779F9U;
    bits = (bits ^ bits >> 30U) * 0xBF58476D1CE4E5B9U;
    bits = (bits ^ bits >> 27U) * 0x94D049BB133111EBU;
    return static_cast<double>((bits ^ bits >> 31U) >> 11U) * 0x1p-53;
}

double joined(double a, double b, double t) {
    return a + (b - a) * (t * t * (3 - 2 * t));
}

} // namespace

double lattice_noise(const glm::dvec3& at) {
    const glm::dvec3 low(std::floor(at.x), std::floor(at.y), std::floor(at.z));
    const glm::dvec3 t = at - low;
    const auto x = static_cast<std::int64_t>(low.x);
    const auto y = static_cast<std::int64_t>(low.y);
    const auto z = static_cast<std::int64_t>(low.z);
    double planes[2];
    for (int k = 0; k < 2; ++k) {
        const double near = joined(at_point(x, y, z + k), at_point(x + 1, y, z + k), t.x);
        const double far = joined(at_point(x, y + 1, z + k), at_point(x + 1, y + 1, z + k), t.x);
        planes[k] = joined(near, far, t.y);
    }
    return joined(planes[0], planes[1], t.z);
}

} // namespace degs
