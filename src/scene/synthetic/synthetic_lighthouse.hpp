// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "scene/synthetic/synthetic_build.hpp"

namespace degs {

/// The parts of the profile `lighthouse`. Surfaces carry flat splats that lie in them, as training
/// leaves them; leaves and blades are needles; sky and clouds are big and far. A scene unit is
/// about 15 m; y points down. Each call adds one Gaussian. Random numbers are drawn one per
/// statement, because operands and arguments have no order.
class Lighthouse {
public:
    Lighthouse(SyntheticBuilder& builder, const std::vector<Camera>& cameras)
        : builder_(builder), random_(builder.random()), cameras_(cameras) {}

    void add_tower();
    void add_lantern();
    void add_house();
    void add_hill();
    void add_grass();
    void add_fence();
    void add_tree();
    void add_boat();
    void add_sea();
    void add_sky();

private:
    static constexpr double kSea = 0.42; ///< y of the water
    static constexpr double kFar = 60;   ///< radius of the sky

    /// Height of the headland above the water; negative outside of it.
    static double hill(double x, double z);
    /// y of the headland.
    static double ground(double x, double z) { return kSea - hill(x, z); }
    static glm::dvec3 to_sun(); ///< of length 1
    /// A splat in a surface, lit by the sun.
    void add_lit(const glm::dvec3& at, const glm::dvec3& normal, const glm::dvec3& rgb,
                 double scale, double rough = 0.2);
    /// A bar from one point to another, `radius` thick, with needles along it.
    void add_bar(const glm::dvec3& from, const glm::dvec3& to, double radius,
                 const glm::dvec3& rgb);
    /// A point of the triangle, evenly.
    glm::dvec3 in_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
    bool near_a_camera(const glm::dvec3& at, double distance) const;

    SyntheticBuilder& builder_;
    SyntheticRandom& random_;
    const std::vector<Camera>& cameras_;
};

// Blends, as shading languages have them.
inline double blend(double a, double b, double t) {
    return a + (b - a) * t;
}
inline glm::dvec3 blend(const glm::dvec3& a, const glm::dvec3& b, double t) {
    return a + (b - a) * t;
}
inline double smooth(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

} // namespace degs
