// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "splat/frame/frame_workload.hpp"
#include "splat/images/image.hpp"
#include "splat/model/spherical_harmonics.hpp"

/// Small scenes and a second, slow opinion on how they look: long double, textbook formulas, every
/// splat on every pixel. Shares nothing with the library but the SH basis, which has its own test.
namespace degs::test {

using Real = long double;
using Matrix = glm::mat<3, 3, Real, glm::defaultp>;
using Vector = glm::vec<3, Real, glm::defaultp>;

constexpr double kPi = 3.14159265358979323846;
inline const glm::vec4 kNoTurn(1, 0, 0, 0);
inline const glm::vec3 kGrey(0.5F);

inline Camera make_camera(int width, int height, double focal) {
    Camera camera;
    camera.width = width;
    camera.height = height;
    camera.fx = camera.fy = focal;
    return camera;
}

inline glm::vec4 turn_about_z(double angle) {
    return {static_cast<float>(std::cos(angle / 2)), 0, 0, static_cast<float>(std::sin(angle / 2))};
}

inline void add_gaussian(GaussianCloud& cloud, const glm::dvec3& mean, const glm::vec3& scale,
                         const glm::vec4& rotation, float opacity, const glm::vec3& rgb) {
    cloud.means.push_back(mean);
    cloud.scales.push_back(scale);
    cloud.rotations.push_back(rotation);
    cloud.opacities.push_back(opacity);
    for (int channel = 0; channel < 3; ++channel) {
        cloud.sh.push_back((rgb[channel] - 0.5F) / 0.28209479F);
    }
}

/// A random unit quaternion in slot order w, x, y, z.
inline glm::vec4 random_rotation(std::mt19937& random) {
    std::normal_distribution<float> normal;
    glm::vec4 q(normal(random), normal(random), normal(random), normal(random));
    return glm::normalize(q);
}

/// Splats of many shapes in front of (and around) a camera at the origin that looks along z.
inline GaussianCloud random_cloud(int count, unsigned seed, int sh_degree = 0) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::normal_distribution<float> normal;
    GaussianCloud cloud;
    cloud.sh_degree = sh_degree;
    for (int i = 0; i < count; ++i) {
        const double z = 3 + 3 * uniform(random);
        cloud.means.emplace_back(0.8 * z * uniform(random), 0.8 * z * uniform(random), z);
        const float size = 0.02F * std::exp(normal(random));
        cloud.scales.emplace_back(size * std::exp(normal(random)), size * std::exp(normal(random)),
                                  size);
        cloud.rotations.push_back(random_rotation(random));
        cloud.opacities.push_back(static_cast<float>(0.5 + 0.5 * uniform(random)));
        for (int k = 0; k < cloud.sh_coefficients() * 3; ++k) {
            cloud.sh.push_back((k < 3 ? 1.0F : 0.2F) * normal(random));
        }
    }
    return cloud;
}

/// Where Gaussian `index` lands, by the formulas of the EWA paper taken literally.
struct BruteSplat {
    Real mu_x, mu_y, a, b, c, det, opacity;
    Vector colour;
    float depth;
    bool visible;
};

inline Matrix rotation_matrix(const glm::vec4& slots) {
    const glm::vec<4, Real, glm::defaultp> q =
        glm::normalize(glm::vec<4, Real, glm::defaultp>(slots));
    const Real w = q[0], x = q[1], y = q[2], z = q[3];
    Matrix m(0);
    m[0] = {w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)};
    m[1] = {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)};
    m[2] = {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z};
    return m;
}

inline BruteSplat brute_project(const GaussianCloud& cloud, std::size_t i, const Camera& camera,
                                const ProjectionOptions& options = {}) {
    BruteSplat out{};
    const Matrix view = glm::transpose(Matrix(camera.camera_to_world));
    const Vector p = view * (Vector(cloud.means[i]) - Vector(camera.position));
    const Real fx = camera.fx, fy = camera.fy;
    const Real limit_x = options.jacobian_clamp * camera.width / (2 * fx);
    const Real limit_y = options.jacobian_clamp * camera.height / (2 * fy);
    const Real tx = std::clamp(p.x / p.z, -limit_x, limit_x) * p.z;
    const Real ty = std::clamp(p.y / p.z, -limit_y, limit_y) * p.z;
    Matrix jacobian(0); // third row stays zero
    jacobian[0] = {fx / p.z, 0, 0};
    jacobian[1] = {0, fy / p.z, 0};
    jacobian[2] = {-fx * tx / (p.z * p.z), -fy * ty / (p.z * p.z), 0};
    Matrix scale(0);
    for (int axis = 0; axis < 3; ++axis) {
        scale[axis][axis] = cloud.scales[i][axis];
    }
    const Matrix rs = rotation_matrix(cloud.rotations[i]) * scale;
    const Matrix t = jacobian * view;
    const Matrix cov = t * (rs * glm::transpose(rs)) * glm::transpose(t);
    out.a = cov[0][0] + options.dilation;
    out.b = cov[1][0];
    out.c = cov[1][1] + options.dilation;
    out.det = out.a * out.c - out.b * out.b;
    out.mu_x = fx * p.x / p.z + (camera.width - 1) / Real(2);
    out.mu_y = fy * p.y / p.z + (camera.height - 1) / Real(2);
    out.opacity = cloud.opacities[i];
    if (options.compensated) {
        const Real before = cov[0][0] * cov[1][1] - cov[1][0] * cov[1][0];
        out.opacity *= std::sqrt(std::max(Real(0.000025), before / out.det));
    }
    out.depth = static_cast<float>(options.order == SplatOrder::Distance ? glm::length(p) : p.z);
    out.visible = p.z > options.near_plane && out.opacity >= options.alpha_min;
    const glm::dvec3 direction = glm::normalize(cloud.means[i] - camera.position);
    const glm::dvec3 sum = evaluate_sh(cloud.sh_degree, cloud.sh_of(i), direction);
    out.colour = glm::max(Vector(sum) + Real(0.5), Vector(0));
    return out;
}

/// Which splats a pixel may see; the original rasteriser restricts them by its tile rectangles.
using MaySee = bool (*)(const BruteSplat&, int x, int y);

struct BruteImage {
    std::vector<Vector> rgb;
    std::vector<Real> transmittance;
    std::vector<std::uint32_t> fragments;
    std::uint64_t terminated = 0;
};

inline std::vector<BruteSplat> brute_order(const GaussianCloud& cloud, const Camera& camera,
                                           const ProjectionOptions& options) {
    std::vector<BruteSplat> splats;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const BruteSplat splat = brute_project(cloud, i, camera, options);
        if (splat.visible) {
            splats.push_back(splat);
        }
    }
    std::stable_sort(splats.begin(), splats.end(),
                     [](const auto& a, const auto& b) { return a.depth < b.depth; });
    return splats;
}

inline void brute_pixel(const std::vector<BruteSplat>& splats, int x, int y,
                        const ProjectionOptions& options, MaySee may_see, BruteImage& image) {
    Vector rgb(0);
    Real transmittance = 1;
    std::uint32_t fragments = 0;
    for (const BruteSplat& s : splats) {
        const Real dx = s.mu_x - x, dy = s.mu_y - y;
        const Real power = -0.5L * (s.c * dx * dx + s.a * dy * dy) / s.det + s.b * dx * dy / s.det;
        const bool cut = options.cut < kNoCut && -2 * power > options.cut;
        if (power > 0 || power < -40 || cut || (may_see != nullptr && !may_see(s, x, y))) {
            continue;
        }
        const Real alpha = std::min(Real(0.99), s.opacity * std::exp(power));
        if (alpha < options.alpha_min) {
            continue;
        }
        const Real next = transmittance * (1 - alpha);
        if (next < Real(1e-4)) {
            ++image.terminated;
            break;
        }
        rgb += s.colour * (alpha * transmittance);
        transmittance = next;
        ++fragments;
    }
    image.rgb.push_back(rgb);
    image.transmittance.push_back(transmittance);
    image.fragments.push_back(fragments);
}

inline BruteImage brute_render(const GaussianCloud& cloud, const Camera& camera,
                               const ProjectionOptions& options = {}, MaySee may_see = nullptr) {
    const std::vector<BruteSplat> splats = brute_order(cloud, camera, options);
    BruteImage image;
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            brute_pixel(splats, x, y, options, may_see, image);
        }
    }
    return image;
}

/// Same fragments in every pixel; colours to the precision of the float image.
inline void expect_same_image(const Image& image, const BruteImage& brute) {
    ASSERT_EQ(image.pixels(), brute.rgb.size());
    EXPECT_EQ(image.fragments, brute.fragments);
    Real worst = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        worst = std::max(worst, std::abs(image.transmittance[i] - brute.transmittance[i]));
        for (int channel = 0; channel < 3; ++channel) {
            const Real value = brute.rgb[i][channel];
            const Real error = std::abs(image.rgb[3 * i + channel] - value);
            worst = std::max(worst, error / std::max(Real(1), value));
        }
    }
    EXPECT_LT(worst, 6e-8L + 1e-9L); // half an ulp of a float below 1, and the double path
}

} // namespace degs::test
