// SPDX-License-Identifier: Apache-2.0
// Profile `outdoor`: statistics between those of flowers and seal (docs/synthetic-scenes.md).
#include <algorithm>
#include <cmath>

#include "scene/synthetic/synthetic_build.hpp"

namespace degs {
namespace {

using Axis = MeasuredDistribution::Axis;

constexpr double kGroundRadius = 1.35;
constexpr double kHazeClearance = 1.0; ///< no haze nearer to a camera

const SyntheticLook& near_look() {
    static const SyntheticLook look{
        {Axis::Logarithmic, {0.0008, 0.0042, 0.0088, 0.0215, 0.045, 0.12}},
        {Axis::Logarithmic, {1, 1.47, 3.5, 10, 22, 100}},
        {Axis::Logarithmic, {1, 1.5, 4.7, 14, 40, 300}},
        {Axis::Linear, {0.003, 0.2, 0.6, 0.98, 0.996, 1}},
        0.3F,
    };
    return look;
}

const SyntheticLook& haze_look() {
    static const SyntheticLook look{
        {Axis::Logarithmic, {0.005, 0.015, 0.045, 0.14, 0.30, 0.6}},
        {Axis::Logarithmic, {1, 1.3, 2.5, 8, 20, 50}},
        {Axis::Logarithmic, {1, 1.3, 3, 15, 60, 500}},
        {Axis::Linear, {0.003, 0.02, 0.08, 0.3, 0.7, 1}},
        0.15F,
    };
    return look;
}

struct Blob {
    glm::dvec3 centre, radii;
    glm::dvec3 rgb;
};
constexpr double kMeadowFloor = 0.35; ///< y of the ground; y points down
const std::array<Blob, 5>& blobs() {
    static const std::array<Blob, 5> all{{
        {{0.0, -0.05, 0.0}, {0.30, 0.40, 0.24}, {0.55, 0.45, 0.35}},
        {{0.45, 0.10, 0.20}, {0.16, 0.25, 0.16}, {0.80, 0.70, 0.20}},
        {{-0.42, 0.05, 0.15}, {0.14, 0.30, 0.14}, {0.75, 0.75, 0.70}},
        {{0.15, 0.15, -0.40}, {0.18, 0.20, 0.12}, {0.60, 0.25, 0.25}},
        {{-0.25, 0.20, -0.35}, {0.20, 0.15, 0.18}, {0.35, 0.40, 0.60}},
    }};
    return all;
}

void add_meadow(SyntheticBuilder& builder) {
    SyntheticRandom& random = builder.random();
    const double radius = kGroundRadius * std::sqrt(random.uniform());
    const glm::dvec2 at = radius * random.on_circle();
    const double blade = random.uniform(); // of grass: most are low
    const glm::dvec3 mean(at.x, kMeadowFloor - 0.12 * blade * blade, at.y);
    // Grass shows every direction, soil faces up.
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0, -0.6, 0) + random.in_ball());
    const glm::dvec3 rgb(0.25 + 0.15 * blade, 0.35 + 0.25 * blade, 0.15);
    builder.add(near_look(), mean, normal, rgb + 0.1 * random.in_ball());
}

void add_blob(SyntheticBuilder& builder) {
    SyntheticRandom& random = builder.random();
    const auto choice = static_cast<std::size_t>(random.uniform() * 5);
    const Blob& blob = blobs()[choice];
    const glm::dvec3 d = random.direction();
    const double depth = random.uniform() < 0.85 ? random.uniform(0.95, 1.01) : random.uniform();
    const glm::dvec3 normal = glm::normalize(d / blob.radii * 0.2 + 0.4 * random.in_ball());
    builder.add(near_look(), blob.centre + depth * blob.radii * d, normal,
                blob.rgb + 0.12 * random.in_ball());
}

void add_haze(SyntheticBuilder& builder, const std::vector<Camera>& cameras) {
    SyntheticRandom& random = builder.random();
    glm::dvec3 mean;
    bool in_the_way = true;
    while (in_the_way) {
        const double radius =
            random.uniform(1.2, 3.5); // a statement per draw: operands have no order
        mean = radius * random.direction();
        mean.y = kMeadowFloor - std::abs(mean.y) * 0.5;
        in_the_way = std::any_of(cameras.begin(), cameras.end(), [&](const Camera& camera) {
            return glm::length(camera.position - mean) < kHazeClearance;
        });
    }
    const glm::dvec3 rgb(0.5 - 0.1 * mean.y, 0.55 - 0.12 * mean.y, 0.5 - 0.2 * mean.y);
    const glm::dvec3 normal = random.direction();
    builder.add(haze_look(), mean, normal, rgb + 0.05 * random.in_ball());
}

} // namespace

void make_outdoor(const SyntheticSpec& spec, SyntheticScene& scene) {
    scene.cameras = synthetic_cameras({{{{1.2, -1.2, -3.0}, {0, 0.1, 0}, 0.8},
                                        {{-1.8, -0.9, -2.2}, {0, 0, 0}, 0.8},
                                        {{0.65, -0.45, -1.05}, {0.15, -0.15, 0}, 0.8}}});
    SyntheticBuilder builder(scene.cloud, spec, 2);
    for (std::uint64_t i = 0; i < spec.gaussians; ++i) {
        const double part = builder.random().uniform();
        if (part < 0.47) {
            add_meadow(builder);
        } else if (part < 0.985) {
            add_blob(builder);
        } else {
            add_haze(builder, scene.cameras);
        }
    }
}

} // namespace degs
