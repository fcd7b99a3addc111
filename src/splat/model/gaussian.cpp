// SPDX-License-Identifier: Apache-2.0
#include "splat/model/gaussian.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/grouped_number.hpp"
#include "base/parallel.hpp"

namespace degs {
namespace {

enum class Defect : std::uint8_t { None, NonFinite, ZeroRotation, BadScale, BadOpacity };

/// By exponent bits, because a branch-free loop over 48 coefficients vectorises.
bool all_finite(const float* values, std::size_t count) {
    constexpr std::uint32_t kExponent = 0x7F800000U;
    bool finite = true;
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, values + i, sizeof bits);
        finite &= (bits & kExponent) != kExponent;
    }
    return finite;
}

bool all_finite(const GaussianCloud& cloud, std::size_t i) {
    const glm::dvec3& mean = cloud.means[i];
    return std::isfinite(mean.x) && std::isfinite(mean.y) && std::isfinite(mean.z) &&
           all_finite(&cloud.scales[i].x, 3) && all_finite(&cloud.rotations[i].x, 4) &&
           std::isfinite(cloud.opacities[i]) &&
           all_finite(cloud.sh_of(i), cloud.sh_coefficients() * 3);
}

Defect find_defect(const GaussianCloud& cloud, std::size_t i) {
    if (!all_finite(cloud, i)) {
        return Defect::NonFinite;
    }
    if (cloud.rotations[i] == glm::vec4(0.0F)) {
        return Defect::ZeroRotation;
    }
    const glm::vec3& scale = cloud.scales[i];
    if (!(scale.x >= 0 && scale.y >= 0 && scale.z >= 0)) {
        return Defect::BadScale;
    }
    const float opacity = cloud.opacities[i];
    return opacity >= 0 && opacity <= 1 ? Defect::None : Defect::BadOpacity;
}

void count(Defect defect, SanitizeReport& report) {
    report.non_finite += defect == Defect::NonFinite;
    report.zero_rotation += defect == Defect::ZeroRotation;
    report.bad_scale += defect == Defect::BadScale;
    report.bad_opacity += defect == Defect::BadOpacity;
}

/// Every finite float squares without overflow or underflow in double. A quaternion that
/// is as close to unit length as rounding to float allows stays as it is, so that
/// sanitizing twice changes nothing.
glm::vec4 unit_rotation(const glm::vec4& rotation) {
    constexpr double kRounding = 1.2e-7; // 2 * 2^-24 relative error of the squared length
    const glm::dvec4 q(rotation);
    const double squared = glm::dot(q, q);
    return std::abs(squared - 1.0) <= kRounding ? rotation : glm::vec4(q / std::sqrt(squared));
}

void move_gaussian(GaussianCloud& cloud, std::size_t from, std::size_t to) {
    const std::size_t sh_values = cloud.sh_coefficients() * 3;
    cloud.means[to] = cloud.means[from];
    cloud.scales[to] = cloud.scales[from];
    cloud.rotations[to] = cloud.rotations[from];
    cloud.opacities[to] = cloud.opacities[from];
    std::copy_n(cloud.sh.data() + from * sh_values, sh_values, cloud.sh.data() + to * sh_values);
}

void truncate(GaussianCloud& cloud, std::size_t size) {
    cloud.means.resize(size);
    cloud.scales.resize(size);
    cloud.rotations.resize(size);
    cloud.opacities.resize(size);
    cloud.sh.resize(size * cloud.sh_coefficients() * 3);
}

} // namespace

SanitizeReport sanitize(GaussianCloud& cloud) {
    std::vector<Defect> defects(cloud.size());
    parallel_ranges(cloud.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            defects[i] = find_defect(cloud, i);
            if (defects[i] == Defect::None) {
                cloud.rotations[i] = unit_rotation(cloud.rotations[i]);
            }
        }
    });
    SanitizeReport report;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        if (defects[i] != Defect::None) {
            count(defects[i], report);
            continue;
        }
        if (kept != i) {
            move_gaussian(cloud, i, kept);
        }
        ++kept;
    }
    if (kept < cloud.size()) {
        truncate(cloud, kept);
    }
    return report;
}

std::string SanitizeReport::explain() const {
    return grouped(total()) +
           " Gaussians of the file cannot be drawn and were dropped: " + grouped(non_finite) +
           " hold NaN or infinity, " + grouped(zero_rotation) + " a rotation of length zero, " +
           grouped(bad_scale) + " a negative scale, " + grouped(bad_opacity) +
           " an opacity outside 0 to 1.";
}

} // namespace degs
