// SPDX-License-Identifier: Apache-2.0
// Profile `object`: statistics between those of st-peter and guitar (docs/synthetic-scenes.md).
#include <cmath>

#include "scene/synthetic/synthetic_build.hpp"

namespace degs {
namespace {

using Axis = MeasuredDistribution::Axis;

const SyntheticLook& object_look() {
    static const SyntheticLook look{
        {Axis::Logarithmic, {0.0008, 0.0048, 0.0155, 0.037, 0.075, 0.2}},
        {Axis::Logarithmic, {1, 1.5, 4.7, 20, 75, 2000}},
        {Axis::Logarithmic, {1, 1.5, 8, 150, 4000, 1e5}},
        {Axis::Linear, {0.003, 0.035, 0.26, 0.97, 0.997, 1}},
        0.3F,
    };
    return look;
}

/// A lumpy egg with a smooth outline; `d` has length 1.
double radius_towards(const glm::dvec3& d) {
    return 0.55 + 0.20 * d.y * d.y + 0.16 * d.x * d.y * d.z + 0.10 * d.z * (3 * d.x * d.x - 1);
}

glm::dvec3 colour_at(const glm::dvec3& d, SyntheticRandom& random) {
    const double stripe = d.y * 6 - std::floor(d.y * 6) < 0.5 ? 0.15 : -0.05;
    const glm::dvec3 base(0.55 + 0.2 * d.x, 0.42 + 0.2 * d.y, 0.3 + 0.2 * d.z);
    return base + stripe + 0.12 * random.in_ball();
}

} // namespace

void make_object(const SyntheticSpec& spec, SyntheticScene& scene) {
    SyntheticBuilder builder(scene.cloud, spec, 3);
    SyntheticRandom& random = builder.random();
    for (std::uint64_t i = 0; i < spec.gaussians; ++i) {
        const glm::dvec3 d = random.direction();
        // Training leaves most Gaussians near the surface, some within, a few floating around.
        const double where = random.uniform();
        const double depth = where < 0.80   ? random.uniform(0.96, 1.01)
                             : where < 0.99 ? random.uniform(0.60, 1.00)
                                            : random.uniform(1.00, 1.40);
        const glm::dvec3 mean = depth * radius_towards(d) * d;
        const glm::dvec3 normal = glm::normalize(d + 0.4 * random.in_ball());
        builder.add(object_look(), mean, normal, colour_at(d, random));
    }
    scene.cameras = synthetic_cameras({{{{1.1, -0.9, -2.9}, {0, 0, 0}, 0.8},
                                        {{-1.8, -0.9, -2.4}, {0, 0, 0}, 0.8},
                                        {{0.7, -0.8, -1.25}, {0.1, -0.15, 0}, 0.8}}});
}

} // namespace degs
