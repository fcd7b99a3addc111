// SPDX-License-Identifier: Apache-2.0
#include "splat/projection.hpp"

#include <algorithm>
#include <cmath>

#include "splat/spherical_harmonics.hpp"

namespace degs {
namespace {

/// Rotation matrix of a quaternion in slot order w, x, y, z. Dividing by |q|^2 makes it orthonormal
/// in double although files store unit quaternions rounded to float; zero gives NaN.
glm::dmat3 rotation_of(const glm::vec4& slots) {
    const double w = slots[0], x = slots[1], y = slots[2], z = slots[3];
    const double s = 2.0 / (w * w + x * x + y * y + z * z);
    return {{1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
            {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)},
            {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)}};
}

double dot(const glm::dvec3& p, const glm::dvec3& q) {
    return glm::dot(p, q);
}

/// x/z of the mean, limited for the Jacobian only: the linearisation is useless far outside.
double limited_slope(double x, double z, double focal, int pixels, double jacobian_clamp) {
    const double limit = jacobian_clamp * pixels / (2.0 * focal);
    return std::clamp(x / z, -limit, limit);
}

/// The dilated covariance from the rows u, v of J Rv R S (2x3). The determinant is Cauchy-Binet's
/// sum of non-negative terms; a c - b^2 loses all digits for needles.
void set_covariance(const glm::dvec3& u, const glm::dvec3& v, double d, ProjectedSplat& out) {
    const double a0 = dot(u, u);
    const double c0 = dot(v, v);
    const glm::dvec3 cross = glm::cross(u, v);
    out.cov_a = a0 + d;
    out.cov_b = dot(u, v);
    out.cov_c = c0 + d;
    out.det = dot(cross, cross) + d * (a0 + c0) + d * d;
}

bool is_degenerate(const ProjectedSplat& s) {
    // One sum catches every NaN and infinity: neither can be cancelled away by finite terms.
    const double sum = std::abs(s.mu_x) + std::abs(s.mu_y) + s.cov_a + std::abs(s.cov_b) + s.cov_c +
                       s.det + s.q_threshold + s.depth;
    return !std::isfinite(sum) || !(s.det > 0);
}

} // namespace

Cull project_anywhere(const GaussianCloud& cloud, std::size_t index, const Camera& camera,
                      const ProjectionOptions& options, ProjectedSplat& out) {
    const glm::dmat3& axes = camera.camera_to_world;
    // Relative to the camera in double first: world offsets of 1e7 must not swallow small splats.
    const glm::dvec3 offset = cloud.means[index] - camera.position;
    const double z = dot(axes[2], offset);
    if (!(z > options.near_plane)) {
        return Cull::Near;
    }
    out.id = static_cast<std::uint32_t>(index);
    out.depth = z;
    out.opacity = cloud.opacities[index];
    out.q_threshold = 2.0 * std::log(out.opacity / options.alpha_min);
    if (!(out.q_threshold >= 0)) {
        return Cull::Transparent;
    }
    const double x = dot(axes[0], offset);
    const double y = dot(axes[1], offset);
    out.mu_x = camera.fx * x / z + 0.5 * camera.width - 0.5;
    out.mu_y = camera.fy * y / z + 0.5 * camera.height - 0.5;

    const double jacobian_clamp = options.jacobian_clamp;
    const double slope_x = limited_slope(x, z, camera.fx, camera.width, jacobian_clamp);
    const double slope_y = limited_slope(y, z, camera.fy, camera.height, jacobian_clamp);
    const glm::dvec3 row_x = (axes[0] - slope_x * axes[2]) * (camera.fx / z); // rows of J Rv
    const glm::dvec3 row_y = (axes[1] - slope_y * axes[2]) * (camera.fy / z);
    const glm::dmat3 rotation = rotation_of(cloud.rotations[index]);
    const glm::dvec3 scale(cloud.scales[index]);
    set_covariance((row_x * rotation) * scale, (row_y * rotation) * scale, options.dilation, out);
    return is_degenerate(out) ? Cull::Degenerate : Cull::None;
}

PixelBox pixel_box(const ProjectedSplat& splat, int width, int height) {
    const double reach_x = std::sqrt(splat.q_threshold * splat.cov_a);
    const double reach_y = std::sqrt(splat.q_threshold * splat.cov_c);
    const double wide_x = reach_x + pixel_slack(std::abs(splat.mu_x) + reach_x);
    const double wide_y = reach_y + pixel_slack(std::abs(splat.mu_y) + reach_y);
    PixelBox box;
    box.x0 = static_cast<int>(std::clamp<double>(std::ceil(splat.mu_x - wide_x), 0, width));
    box.x1 = static_cast<int>(std::clamp<double>(std::floor(splat.mu_x + wide_x), -1, width - 1));
    box.y0 = static_cast<int>(std::clamp<double>(std::ceil(splat.mu_y - wide_y), 0, height));
    box.y1 = static_cast<int>(std::clamp<double>(std::floor(splat.mu_y + wide_y), -1, height - 1));
    return box;
}

Cull project(const GaussianCloud& cloud, std::size_t index, const Camera& camera,
             const ProjectionOptions& options, ProjectedSplat& out) {
    const Cull cull = project_anywhere(cloud, index, camera, options, out);
    if (cull != Cull::None) {
        return cull;
    }
    return pixel_box(out, camera.width, camera.height).empty() ? Cull::OffScreen : Cull::None;
}

void shade(const GaussianCloud& cloud, std::size_t index, const Camera& camera,
           ProjectedSplat& out) {
    const glm::dvec3 direction = glm::normalize(cloud.means[index] - camera.position);
    const glm::dvec3 sum = evaluate_sh(cloud.sh_degree, cloud.sh_of(index), direction);
    for (int channel = 0; channel < 3; ++channel) {
        const double value = 0.5 + sum[channel];
        out.colour[channel] = value > 0 ? value : 0.0; // NaN becomes black
    }
}

} // namespace degs
