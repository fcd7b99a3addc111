// SPDX-License-Identifier: Apache-2.0
#include "accuracy/flip/flip_colour.hpp"

#include <algorithm>
#include <cmath>

namespace degs {
namespace {

/// Linear sRGB to XYZ, IEC 61966-2-1; glm stores columns.
const glm::dmat3 kXyzOfRgb(0.4124, 0.2126, 0.0193, 0.3576, 0.7152, 0.1192, 0.1805, 0.0722, 0.9505);
const glm::dmat3 kRgbOfXyz = glm::inverse(kXyzOfRgb);
const glm::dvec3 kWhite = kXyzOfRgb * glm::dvec3(1.0);

double linear_of(double srgb) {
    const double value = std::clamp(srgb, 0.0, 1.0);
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// CIELAB's compressive function.
double cube_root_of(double ratio) {
    constexpr double kDelta = 6.0 / 29.0;
    return ratio > kDelta * kDelta * kDelta ? std::cbrt(ratio)
                                            : ratio / (3 * kDelta * kDelta) + 4.0 / 29.0;
}

} // namespace

glm::dvec3 linear_of_srgb(const glm::dvec3& srgb) {
    return {linear_of(srgb.x), linear_of(srgb.y), linear_of(srgb.z)};
}

glm::dvec3 ycxcz_of_linear(const glm::dvec3& rgb) {
    const glm::dvec3 xyz = (kXyzOfRgb * rgb) / kWhite;
    return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)};
}

glm::dvec3 linear_of_ycxcz(const glm::dvec3& ycxcz) {
    const double y = (ycxcz.x + 16) / 116;
    return kRgbOfXyz * (glm::dvec3(y + ycxcz.y / 500, y, y - ycxcz.z / 200) * kWhite);
}

glm::dvec3 hunt_lab_of_linear(const glm::dvec3& rgb) {
    const glm::dvec3 xyz = (kXyzOfRgb * rgb) / kWhite;
    const double x = cube_root_of(xyz.x);
    const double y = cube_root_of(xyz.y);
    const double z = cube_root_of(xyz.z);
    const double lightness = 116 * y - 16;
    return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

double hyab_distance(const glm::dvec3& lab, const glm::dvec3& other) {
    const glm::dvec3 d = lab - other;
    return std::abs(d.x) + std::hypot(d.y, d.z);
}

} // namespace degs
