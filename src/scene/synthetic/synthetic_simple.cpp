// SPDX-License-Identifier: Apache-2.0
// Profiles that stress one thing: dense, uniform, single and needles.
#include <cmath>

#include "scene/synthetic/synthetic_build.hpp"

namespace degs {
namespace {

using Axis = MeasuredDistribution::Axis;

/// Faint and of moderate shape; depth complexity does the rest.
const SyntheticLook& dense_look() {
    static const SyntheticLook look{
        {Axis::Logarithmic, {0.004, 0.010, 0.026, 0.06, 0.11, 0.3}},
        {Axis::Logarithmic, {1, 1.5, 3.6, 10, 30, 100}},
        {Axis::Logarithmic, {1, 1.3, 3, 15, 60, 500}},
        {Axis::Linear, {0.005, 0.015, 0.05, 0.15, 0.4, 0.9}},
        0.2F,
    };
    return look;
}

/// A point of the box [-1, 1]^3.
glm::dvec3 in_box(SyntheticRandom& random) {
    const double x = random.uniform(-1, 1); // in this order: arguments of a call have none
    const double y = random.uniform(-1, 1);
    const double z = random.uniform(-1, 1);
    return {x, y, z};
}

/// Bright in the middle of the box, its position as the hue.
glm::dvec3 colour_of(const glm::dvec3& position) {
    return 0.5 + 0.4 * position;
}

/// Views of the box [-1, 1]^3 that stay outside of it.
std::vector<Camera> box_cameras() {
    return synthetic_cameras({{{{1.2, -1.0, -3.4}, {0, 0, 0}, 0.8},
                               {{-1.2, -0.6, -2.4}, {0, 0, 0}, 0.8},
                               {{0.3, -0.3, -1.5}, {0, 0, 0}, 0.8}}});
}

} // namespace

void make_dense(const SyntheticSpec& spec, SyntheticScene& scene) {
    SyntheticBuilder builder(scene.cloud, spec, 3);
    SyntheticRandom& random = builder.random();
    for (std::uint64_t i = 0; i < spec.gaussians; ++i) {
        const glm::dvec3 mean = in_box(random);
        builder.add(dense_look(), mean, random.direction(), colour_of(mean));
    }
    scene.cameras = box_cameras();
}

void make_uniform(const SyntheticSpec& spec, SyntheticScene& scene) {
    SyntheticBuilder builder(scene.cloud, spec, 0);
    SyntheticRandom& random = builder.random();
    for (std::uint64_t i = 0; i < spec.gaussians; ++i) {
        const glm::dvec3 mean = in_box(random);
        const double size = 0.012 * random.uniform(0.5, 1.5) * builder.size_factor();
        const double opacity = random.uniform(0.05, 1.0);
        builder.add_exact(mean, glm::dvec3(size), {1, 0, 0, 0}, opacity, colour_of(mean));
    }
    scene.cameras = box_cameras();
}

void make_single(const SyntheticSpec& spec, SyntheticScene& scene) {
    SyntheticBuilder builder(scene.cloud, spec, 0);
    builder.add_exact({0, 0, 0}, {0.30, 0.20, 0.25}, {1, 0, 0, 0}, 0.8, {0.9, 0.6, 0.2});
    scene.cameras = box_cameras();
}

void make_needles(const SyntheticSpec& spec, SyntheticScene& scene) {
    SyntheticBuilder builder(scene.cloud, spec, 0);
    SyntheticRandom& random = builder.random();
    const MeasuredDistribution aspect(Axis::Logarithmic, {100, 200, 3000, 5e4, 9e4, 1e5});
    const double factor = std::sqrt(builder.size_factor() / 10); // length, so that 1000 have 1
    for (std::uint64_t i = 0; i < spec.gaussians; ++i) {
        const glm::dvec3 mean = in_box(random);
        const double length = random.uniform(0.05, 0.5) * std::min(1.0, factor);
        const double width = length / aspect.sample(random);
        const glm::dvec4 rotation = builder.facing(random.direction()); // the needle is the z axis
        const double opacity = random.uniform(0.3, 1.0);
        builder.add_exact(mean, {width, width, length}, rotation, opacity, colour_of(mean));
    }
    scene.cameras = box_cameras();
}

} // namespace degs
