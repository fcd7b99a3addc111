// SPDX-License-Identifier: Apache-2.0
// Profile `landscape`: an outdoor capture as a whole, from the object in its middle to the sky. The
// counts that it imitates are in docs/synthetic-scenes.md.
#include <algorithm>
#include <cmath>

#include "scene/synthetic/synthetic_build.hpp"

namespace degs {
namespace {

using Axis = MeasuredDistribution::Axis;

constexpr double kFloor = 0.35;      ///< y of the ground; y points down
constexpr double kTable = 1.1;       ///< radius of what stands in the middle
constexpr double kMiddleScale = 0.6; ///< the middle is seen by all views and trained finest
constexpr double kClearance = 0.8;   ///< nothing but the ground nearer to a camera

/// Sizes at the distance of the middle; what is farther away grows with its distance, because
/// training gives the Gaussians of all distances about the same size in pixels.
const SyntheticLook& plain_look() {
    static const SyntheticLook look{
        {Axis::Logarithmic, {0.003, 0.010, 0.026, 0.072, 0.18, 0.6}},
        {Axis::Logarithmic, {1, 1.25, 2.4, 7, 18, 80}},
        {Axis::Logarithmic, {1, 1.5, 5, 25, 100, 1000}},
        {Axis::Linear, {0.003, 0.03, 0.12, 0.75, 0.99, 1}},
        0.25F,
    };
    return look;
}

/// Log-uniform between both.
double spread(SyntheticRandom& random, double low, double high) {
    return low * portable_exp(random.uniform() * portable_log(high / low));
}

/// A place on the ground at this distance from the middle.
glm::dvec3 around(SyntheticRandom& random, double radius) {
    const glm::dvec2 at = radius * random.on_circle();
    return {at.x, kFloor, at.y};
}

/// Sizes of what lies at `mean` over those in the middle.
double growth(const glm::dvec3& mean) {
    return std::max(1.0, glm::length(mean) / 2.5);
}

/// A table with what stands on it: a box and a bowl, hollow.
void add_middle(SyntheticBuilder& builder) {
    SyntheticRandom& random = builder.random();
    const bool bowl = random.uniform() < 0.2;
    const glm::dvec3 centre(0, bowl ? -0.4 : 0.05, 0);
    const glm::dvec3 radii = bowl ? glm::dvec3(0.2, 0.22, 0.2) : glm::dvec3(kTable, 0.3, kTable);
    const glm::dvec3 d = random.direction();
    const double depth = random.uniform() < 0.85 ? random.uniform(0.95, 1.01) : random.uniform();
    const glm::dvec3 normal = glm::normalize(d / radii * 0.2 + 0.4 * random.in_ball());
    const glm::dvec3 rgb = bowl ? glm::dvec3(0.4, 0.5, 0.3) : glm::dvec3(0.5, 0.4, 0.3);
    builder.add(plain_look(), centre + depth * radii * d, normal, rgb + 0.15 * random.in_ball(),
                kMiddleScale);
}

/// Grass, dense in the middle.
void add_ground(SyntheticBuilder& builder) {
    SyntheticRandom& random = builder.random();
    glm::dvec3 mean = around(random, spread(random, 0.3, 40));
    const double scale = growth(mean);
    const double blade = random.uniform();
    mean.y -= 0.06 * scale * blade * blade;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0, -0.7, 0) + random.in_ball());
    const glm::dvec3 rgb(0.25 + 0.15 * blade, 0.35 + 0.2 * blade, 0.15);
    builder.add(plain_look(), mean, normal, rgb + 0.1 * random.in_ball(), scale);
}

/// Bushes, trees and houses around, in clumps.
void add_surroundings(SyntheticBuilder& builder, const std::vector<Camera>& cameras) {
    SyntheticRandom& random = builder.random();
    glm::dvec3 mean;
    bool in_the_way = true;
    while (in_the_way) {
        const double radius = spread(random, 4.5, 30);
        mean = around(random, radius);
        // Taller where two waves around the middle meet, so that the sky line is uneven.
        const double wave = mean.x * mean.x / (radius * radius) * (mean.z > 0 ? 1 : 0.6);
        mean.y -= radius * (0.08 + 0.35 * wave) * std::sqrt(random.uniform());
        in_the_way = std::any_of(cameras.begin(), cameras.end(), [&](const Camera& camera) {
            return glm::length(camera.position - mean) < kClearance;
        });
    }
    const glm::dvec3 rgb(0.2, 0.3 + 0.1 * random.uniform(), 0.15);
    const glm::dvec3 normal = random.direction();
    builder.add(plain_look(), mean, normal, rgb + 0.15 * random.in_ball(), growth(mean));
}

/// Hills and sky, all around.
void add_distance(SyntheticBuilder& builder) {
    SyntheticRandom& random = builder.random();
    glm::dvec3 d = random.direction();
    d.y = -std::abs(d.y) * random.uniform(); // low more often than high
    const glm::dvec3 away = glm::normalize(d);
    const glm::dvec3 mean = spread(random, 40, 100) * away;
    const glm::dvec3 grey = 0.05 * random.in_ball(); // in this order: arguments of a call have none
    const glm::dvec3 normal = glm::normalize(-away + 0.5 * random.in_ball());
    const glm::dvec3 rgb(0.55, 0.65, 0.75 - 0.2 * away.y);
    builder.add(plain_look(), mean, normal, rgb + grey, 1.6 * growth(mean));
}

} // namespace

void make_landscape(const SyntheticSpec& spec, SyntheticScene& scene) {
    scene.cameras = synthetic_cameras({{{{2.4, -1.3, -3.0}, {0, 0, 0}, 0.8},
                                        {{-2.2, -1.1, -2.4}, {0, -0.1, 0}, 0.8},
                                        {{1.3, -0.9, -1.9}, {0, -0.1, 0}, 0.8}}});
    SyntheticBuilder builder(scene.cloud, spec, 3);
    for (std::uint64_t i = 0; i < spec.gaussians; ++i) {
        const double part = builder.random().uniform();
        if (part < 0.25) {
            add_middle(builder);
        } else if (part < 0.60) {
            add_ground(builder);
        } else if (part < 0.90) {
            add_surroundings(builder, scene.cameras);
        } else {
            add_distance(builder);
        }
    }
}

} // namespace degs
