// SPDX-License-Identifier: Apache-2.0
#include "scene/dynamic/synthetic_dynamic.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "scene/synthetic/synthetic_build.hpp"

namespace degs {
namespace {

/// Adds Gaussians one by one; sizes shrink as the count grows, as in other synthetic scenes.
class SpacetimeBuilder {
public:
    explicit SpacetimeBuilder(const SyntheticSpec& spec)
        : random_(spec.seed), size_(std::sqrt(1e5 / static_cast<double>(spec.gaussians))) {
        scene_.reserve(spec.gaussians);
    }

    SyntheticRandom& random() { return random_; }

    /// A still disc at `mean` that faces `normal`, there all the time. `size` is its typical
    /// standard deviation in scene units for 100 000 Gaussians.
    SpacetimeGaussian& add(const glm::dvec3& mean, const glm::dvec3& normal, double size,
                           const glm::dvec3& rgb) {
        SpacetimeGaussian g;
        g.mean = glm::vec3(mean);
        g.centre = 0.5F;
        g.log_duration = kAlways;
        g.rgb = glm::vec3(glm::clamp(rgb + 0.06 * random_.in_ball(), 0.0, 1.0));
        g.opacity = static_cast<float>(random_.uniform(-1, 5));
        const double spread = portable_log(size * size_) + random_.uniform(-1.2, 1.2);
        g.log_scale = glm::vec3(glm::dvec3(spread + random_.uniform(0, 1.5), spread, spread - 3));
        // The half turn between z and the normal is the quaternion (0, z + normal).
        const glm::dvec3 half = glm::dvec3(0, 0, 1.000001) + normal;
        const glm::dvec3 axis = half / glm::length(half);
        const glm::dvec2 turn = random_.on_circle(); // about z before
        g.rotation = glm::vec4(glm::dvec4(-axis.z * turn.y, axis.x * turn.x + axis.y * turn.y,
                                          axis.y * turn.x - axis.x * turn.y, axis.z * turn.x));
        return scene_.emplace_back(g);
    }

    SpacetimeCloud take() { return std::move(scene_); }

private:
    static constexpr float kAlways = 4; ///< fades by 0.01 % within the scene
    SpacetimeCloud scene_;
    SyntheticRandom random_;
    double size_;
};

void add_table(SpacetimeBuilder& builder) {
    SyntheticRandom& random = builder.random();
    const double z = random.uniform(-0.9, 0.9); // before x: arguments of a call have no order
    const glm::dvec3 at(random.uniform(-1.6, 1.6), 0.6, z);
    const double board = at.x * 3 - std::floor(at.x * 3) < 0.9 ? 0.0 : -0.15;
    builder.add(at, {0, -1, 0}, 0.007, glm::dvec3(0.5, 0.36, 0.24) + board);
}

void add_wall(SpacetimeBuilder& builder) {
    SyntheticRandom& random = builder.random();
    const double y = random.uniform(-2.2, 1.6);
    const glm::dvec3 at(random.uniform(-3, 3), y, 2.2);
    builder.add(at, {0, 0, -1}, 0.016, {0.62, 0.64, 0.6});
}

/// Cups and bowls.
void add_thing(SpacetimeBuilder& builder) {
    SyntheticRandom& random = builder.random();
    const int which = static_cast<int>(random.uniform(0, 5));
    const glm::dvec3 d = random.direction();
    const glm::dvec3 centre(-1.3 + 0.62 * which, 0.42, 0.35 - 0.28 * (which % 3));
    const glm::dvec3 rgb(0.25 + 0.12 * which, 0.5 - 0.06 * which, 0.3 + 0.1 * (which % 2));
    builder.add(centre + 0.17 * d, d, 0.004, rgb);
}

/// Flies from left to right, up and down again, and turns.
void add_ball(SpacetimeBuilder& builder) {
    SyntheticRandom& random = builder.random();
    const glm::dvec3 d = random.direction();
    const double stripe = d.y * 3 - std::floor(d.y * 3) < 0.5 ? 0.25 : -0.1;
    SpacetimeGaussian& g = builder.add(glm::dvec3(0, -0.75, -0.3) + 0.26 * d, d, 0.005,
                                       glm::dvec3(0.75, 0.3, 0.2) + stripe);
    // About z by 2 radians in all: the shift of its surface to first order in time.
    g.motion[0] = glm::vec3(glm::dvec3(2.2, 0, 0) + 0.52 * glm::dvec3(-d.y, d.x, 0));
    g.motion[1] = {0, 4.0F, 0};
    g.omega = glm::vec4(-g.rotation.w, -g.rotation.z, g.rotation.y, g.rotation.x);
}

/// Bends to one side and to the other, the more the higher.
void add_column(SpacetimeBuilder& builder) {
    SyntheticRandom& random = builder.random();
    const glm::dvec2 side = random.on_circle();
    const double height = random.uniform(0, 1.3);
    SpacetimeGaussian& g =
        builder.add({0.95 + 0.12 * side.x, 0.6 - height, 0.1 + 0.12 * side.y}, {side.x, 0, side.y},
                    0.0045, glm::dvec3(0.2, 0.35 + 0.3 * height, 0.25));
    const double bend = height * height;
    g.motion[0] = glm::vec3(glm::dvec3(1.4 * bend, 0, 0.5 * bend));
    g.motion[2] = glm::vec3(glm::dvec3(-5.0 * bend, 0, 0));
}

/// A puff that rises, turns grey and is gone after a tenth of the scene.
void add_steam(SpacetimeBuilder& builder) {
    SyntheticRandom& random = builder.random();
    const glm::dvec3 puff = 0.22 * random.in_ball();
    const glm::dvec3 at = glm::dvec3(-0.68, 0.1 - random.uniform(0, 0.7), 0.07) + puff;
    SpacetimeGaussian& g = builder.add(at, random.direction(), 0.011, {0.8, 0.8, 0.82});
    g.centre = static_cast<float>(random.uniform(-0.05, 1.05));
    g.log_duration = static_cast<float>(random.uniform(-3.2, -2.2));
    g.opacity = static_cast<float>(random.uniform(-4, -1.5));
    g.motion[0] = glm::vec3(glm::dvec3(0, -1.2, 0) + 0.5 * random.in_ball());
    g.log_scale = glm::vec3(g.log_scale.x, g.log_scale.x - 0.2F, g.log_scale.x - 0.4F);
}

} // namespace

SpacetimeCloud make_spacetime(const SyntheticSpec& spec) {
    struct Part {
        double share; ///< of the Gaussians
        void (*add)(SpacetimeBuilder& builder);
    };
    constexpr Part kParts[] = {{0.24, add_table}, {0.20, add_wall},   {0.20, add_thing},
                               {0.14, add_ball},  {0.12, add_column}, {0.10, add_steam}};
    SpacetimeBuilder builder(spec);
    for (std::uint64_t i = 0; i < spec.gaussians; ++i) {
        double where = builder.random().uniform();
        const Part* part = kParts;
        while (where >= part->share && part != std::end(kParts) - 1) {
            where -= part->share;
            ++part;
        }
        part->add(builder);
    }
    return builder.take();
}

void make_dynamic(const SyntheticSpec& spec, SyntheticScene& scene) {
    scene.cloud = at_time(make_spacetime(spec), spec.time.value_or(0));
    scene.cameras = synthetic_cameras({{{{0.2, -1.1, -3.2}, {0, 0.05, 0}, 0.8},
                                        {{-1.4, -0.9, -2.4}, {0, 0.1, 0}, 0.8},
                                        {{0.6, -0.6, -1.6}, {0.1, -0.1, 0}, 0.8}}});
}

} // namespace degs
