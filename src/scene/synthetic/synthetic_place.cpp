// SPDX-License-Identifier: Apache-2.0
// Captures of whole places, as profiles `interior` and `garden` are.
#include "scene/synthetic/synthetic_place.hpp"

#include <algorithm>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "scene/synthetic/synthetic_noise.hpp"

namespace degs {
namespace {

using Axis = MeasuredDistribution::Axis;

constexpr double kLensClearance = 0.45; ///< nothing nearer to a camera, scene units
constexpr double kFloaters = 0.06;      ///< share of splats that hang before their surface
constexpr double kFloaterReach = 0.35;  ///< scene units
/// Median standard deviation of a sky splat as an angle, times the root of how many there are. With
/// it 30 to 40 splats are drawn on a pixel of the sky, however many there are.
constexpr double kSkyReach = 3.0;
constexpr double kMostSkyAngle = 0.6; ///< rad

/// Between two levels by the logarithm of the number of Gaussians; the outer slopes continue.
PlaceLevel level_at(double gaussians, const std::vector<PlaceLevel>& levels) {
    std::size_t i = 1;
    while (i + 1 < levels.size() && gaussians > levels[i].gaussians) {
        ++i;
    }
    const PlaceLevel& a = levels[i - 1];
    const PlaceLevel& b = levels[i];
    const double t =
        portable_log(gaussians / a.gaussians) / portable_log(b.gaussians / a.gaussians);
    const double size = a.size * portable_exp(t * portable_log(b.size / a.size));
    // Beyond the outer levels sizes spread as they do there.
    const double spread = a.spread + std::clamp(t, 0.0, 1.0) * (b.spread - a.spread);
    return {gaussians, size, std::max(0.2, a.opacity + t * (b.opacity - a.opacity)), spread};
}

double fraction_of(double x) {
    return x - std::floor(x);
}

/// How much of the other colour a place of a surface has; u and v are scene units along it.
double mix_of(Pattern pattern, double u, double v, const glm::dvec3& at) {
    switch (pattern) {
    case Pattern::Boards: {
        const double board = std::floor(v / 0.14);
        const bool gap = fraction_of(v / 0.14) < 0.07;
        return gap ? 1.4
                   : 0.8 * lattice_noise({board * 3.7, std::floor(u / 1.1 + board * 0.37), 5});
    }
    case Pattern::Tiles: {
        const bool joint = fraction_of(u / 0.3) < 0.08 || fraction_of(v / 0.3) < 0.08;
        return joint ? 1 : 0.3 * lattice_noise(7.0 * at);
    }
    case Pattern::Pane:
        return fraction_of(u / 0.6) < 0.09 || fraction_of(v / 0.7) < 0.08 ? 1 : 0;
    case Pattern::Leaves:
        return 1.3 * lattice_noise(9.0 * at) * lattice_noise(31.0 * at);
    case Pattern::Picture:
        return lattice_noise(glm::dvec3(4 * u, 9 * v, 3)) > 0.5 ? 1 : 0.2;
    default:
        return 0.4 * lattice_noise(3.0 * at);
    }
}

glm::dvec3 book_colour(double u, double v) {
    const double book = std::floor(u / 0.045);
    const double shelf = std::floor(v / 0.36);
    const double height = 0.7 + 0.25 * lattice_noise({book * 5.3, shelf * 7, 1});
    if (fraction_of(v / 0.36) > height) {
        return {0.10, 0.07, 0.05};
    }
    const double hue = lattice_noise({book * 9.1, shelf * 3.3, 8});
    const double light = 0.35 + 0.6 * lattice_noise({book * 7.7, shelf * 11.9, 4});
    return light * (hue < 0.4   ? glm::dvec3(0.85, 0.25, 0.18)
                    : hue < 0.5 ? glm::dvec3(0.90, 0.82, 0.60)
                    : hue < 0.6 ? glm::dvec3(0.20, 0.50, 0.35)
                                : glm::dvec3(0.20, 0.32, 0.65));
}

/// Unit quaternion (w, x, y, z) that takes z to `normal` and the longest axis, x, near the
/// vertical: the closer, the larger `upright` is.
glm::dvec4 turned(SyntheticRandom& random, const glm::dvec3& normal, double upright) {
    const glm::dvec3 stem = glm::dvec3(0, -upright, 0) + random.in_ball();
    const glm::dvec3 across = glm::cross(normal, stem);
    const double length = std::sqrt(glm::dot(across, across));
    if (length < 1e-6) {
        return {1, 0, 0, 0};
    }
    const glm::dvec3 y = across / length;
    const glm::dquat turn = glm::quat_cast(glm::dmat3(glm::cross(y, normal), y, normal));
    return {turn.w, turn.x, turn.y, turn.z};
}

} // namespace

SyntheticPlace::SyntheticPlace(const SyntheticSpec& spec, const std::vector<PlaceLevel>& levels,
                               const PlaceShapes& shapes)
    : spec_(spec), level_(level_at(static_cast<double>(spec.gaussians), levels)), shapes_(shapes) {
    shapes_.sizes.raise_to(level_.spread);
}

void SyntheticPlace::push(Part part, double area, double density) {
    part.until = (parts_.empty() ? 0 : parts_.back().until) + area * density;
    parts_.push_back(part);
}

void SyntheticPlace::sheet(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v,
                           const Material& material, double density) {
    const glm::dvec3 across = glm::cross(u, v);
    const double area = std::sqrt(glm::dot(across, across));
    push({false, corner, u, v, across / area, material, 0}, area, density);
}

void SyntheticPlace::box(const glm::dvec3& low, const glm::dvec3& high, const Material& material,
                         double density) {
    const glm::dvec3 size = high - low;
    const glm::dvec3 x(size.x, 0, 0);
    const glm::dvec3 y(0, size.y, 0);
    const glm::dvec3 z(0, 0, size.z);
    sheet(low, y, x, material, density);
    sheet(high, -x, -y, material, density);
    sheet(low, x, z, material, density);
    sheet(high, -z, -x, material, density);
    sheet(low, z, y, material, density);
    sheet(high, -y, -z, material, density);
}

void SyntheticPlace::ball(const glm::dvec3& centre, const glm::dvec3& radii,
                          const Material& material, double density) {
    const double mean = (radii.x * radii.y + radii.y * radii.z + radii.z * radii.x) / 3;
    push({true, centre, radii, {}, {}, material, 0}, 12.566 * mean, density);
}

void SyntheticPlace::add(SyntheticBuilder& builder, const Part& part) const {
    SyntheticRandom& random = builder.random();
    const Material& material = part.material;
    const double a = random.uniform();
    const double b = random.uniform();
    const glm::dvec3 d = random.direction();
    glm::dvec3 at = part.corner + a * part.u + b * part.v;
    glm::dvec3 normal = part.normal;
    if (part.ball) {
        const double shell = 1 - material.depth * a * b;
        at = part.corner + shell * d * part.u;
        normal = glm::normalize(d / part.u);
    } else {
        const bool floats = random.uniform() < kFloaters;
        const double lift = random.uniform(-1, 1);
        at += (floats ? kFloaterReach * lift * lift : material.depth * lift) * part.normal;
    }
    const double u = part.ball ? 0 : a * std::sqrt(glm::dot(part.u, part.u));
    const double v = part.ball ? 0 : b * std::sqrt(glm::dot(part.v, part.v));
    glm::dvec3 rgb =
        material.pattern == Pattern::Books
            ? book_colour(u, v)
            : glm::mix(material.rgb, material.other, mix_of(material.pattern, u, v, at));
    const double light = 0.84 + 0.08 * std::abs(normal.z) - 0.10 * normal.y;
    rgb = light * rgb + 0.03 * random.in_ball();
    static const MeasuredDistribution flatness(Axis::Logarithmic, {1, 1.8, 6, 25, 90, 600});
    const double largest = shapes_.sizes.sample(random) * 1.22 * level_.size * material.size;
    const double middle = largest / shapes_.elongations.sample(random);
    const double smallest = std::max(middle / flatness.sample(random), 1e-9);
    const glm::dvec3 leaning = glm::normalize(normal + material.rough * random.in_ball());
    const double upright = std::max(material.upright, shapes_.upright);
    const glm::dvec4 rotation =
        upright > 0 ? turned(random, leaning, upright) : builder.facing(leaning);
    const double rank = random.uniform();
    const double opacity =
        0.006 + 0.99 * material.opacity * portable_exp(level_.opacity * portable_log(rank + 1e-9));
    builder.add_exact(at, {largest, middle, smallest}, rotation, std::min(opacity, 0.996), rgb,
                      0.05F);
}

void SyntheticPlace::add_sky(SyntheticBuilder& builder, double far) const {
    SyntheticRandom& random = builder.random();
    glm::dvec3 d = random.direction();
    d.y = -std::abs(d.y);
    static const MeasuredDistribution spread(Axis::Logarithmic, {0.25, 0.5, 1, 2.1, 3.3, 5});
    static const MeasuredDistribution faint(Axis::Linear, {0.004, 0.008, 0.04, 0.2, 0.6, 0.9});
    const double many = std::max(1.0, spec_.sky * static_cast<double>(spec_.gaussians));
    const double angle =
        std::min(kMostSkyAngle, kSkyReach / std::sqrt(many) * spread.sample(random));
    const double opacity = faint.sample(random);
    const double distance = far * random.uniform(1, 2);
    const double size = distance * angle;
    const glm::dvec3 rgb = glm::mix(glm::dvec3(0.80, 0.86, 0.92), {0.35, 0.55, 0.85}, -d.y);
    builder.add_exact(distance * d, {size, 0.7 * size, 0.1 * size}, builder.facing(-d), opacity,
                      rgb, 0.01F);
}

void SyntheticPlace::fill(GaussianCloud& cloud, const std::vector<Camera>& cameras,
                          double far) const {
    SyntheticBuilder builder(cloud, spec_, 1);
    const double whole = parts_.back().until;
    const auto ends_before = [](const Part& part, double place) { return part.until <= place; };
    while (cloud.size() < spec_.gaussians) {
        if (builder.random().uniform() < spec_.sky) {
            add_sky(builder, far);
            continue;
        }
        const double place = builder.random().uniform() * whole;
        add(builder, *std::lower_bound(parts_.begin(), parts_.end() - 1, place, ends_before));
        const glm::dvec3 at = cloud.means.back();
        const bool close = std::any_of(cameras.begin(), cameras.end(), [&](const Camera& camera) {
            return glm::length(camera.position - at) < kLensClearance;
        });
        if (close) {
            // It goes beyond the ground instead, where no camera looks.
            cloud.means.back() = at + glm::dvec3(0, 2.5 * far, 0);
        }
    }
}

std::vector<Camera> place_cameras(const std::array<SyntheticView, 3>& views) {
    std::vector<Camera> cameras = synthetic_cameras(views);
    for (Camera& camera : cameras) {
        const bool overview = camera.id == 0;
        camera.width = overview ? 1440 : 1920;
        camera.height = 1080;
        camera.fx = camera.fy = views[static_cast<std::size_t>(camera.id)].focal * camera.width;
    }
    return cameras;
}

} // namespace degs
