// SPDX-License-Identifier: Apache-2.0
// Profile `lighthouse`: headland, plants, sea and sky.
#include <algorithm>
#include <array>
#include <cmath>

#include "scene/synthetic/synthetic_lighthouse.hpp"
#include "scene/synthetic/synthetic_noise.hpp"

namespace degs {
namespace {

using Axis = MeasuredDistribution::Axis;

const SyntheticLook& needle_look() {
    static const SyntheticLook look{
        {Axis::Logarithmic, {0.003, 0.006, 0.012, 0.022, 0.04, 0.08}},
        {Axis::Logarithmic, {2, 4, 7, 14, 30, 120}},
        {Axis::Logarithmic, {1, 1.2, 2, 5, 15, 80}},
        {Axis::Linear, {0.02, 0.2, 0.75, 0.98, 0.996, 1}},
        0.06F,
    };
    return look;
}

/// Per unit of distance from the middle.
const SyntheticLook& far_look() {
    static const SyntheticLook look{
        {Axis::Logarithmic, {0.004, 0.012, 0.022, 0.04, 0.06, 0.1}},
        {Axis::Logarithmic, {1, 1.2, 2.2, 6, 15, 40}},
        {Axis::Logarithmic, {1, 1.5, 5, 20, 60, 300}},
        {Axis::Linear, {0.01, 0.1, 0.5, 0.95, 0.99, 1}},
        0.02F,
    };
    return look;
}

const SyntheticLook& cloud_look() {
    static const SyntheticLook look{
        {Axis::Logarithmic, {0.015, 0.03, 0.05, 0.08, 0.11, 0.15}},
        {Axis::Logarithmic, {1, 1.1, 1.6, 3, 6, 10}},
        {Axis::Logarithmic, {1, 1.2, 2, 5, 20, 60}},
        {Axis::Linear, {0.01, 0.03, 0.12, 0.4, 0.7, 0.9}},
        0.02F,
    };
    return look;
}

} // namespace

double Lighthouse::hill(double x, double z) {
    constexpr double kHeight = 0.40;
    constexpr double kRadius = 1.15; // where it is about 1/e as high
    const double r2 = (x * x + 1.25 * z * z) / (kRadius * kRadius);
    const double plateau = kHeight * portable_exp(-r2 * r2);
    return plateau + 0.05 * (lattice_noise({2.5 * x, 7, 2.5 * z}) - 0.5) - 0.03;
}

// Grass on top, rock where it is steep, sand at the water, and a path to the door.
void Lighthouse::add_hill() {
    double x = 0;
    double z = 0;
    double high = -1;
    while (high < -0.02) {
        x = random_.uniform(-1.75, 1.75);
        z = random_.uniform(-1.6, 1.6);
        high = hill(x, z);
    }
    constexpr double kStep = 0.01;
    const glm::dvec3 normal =
        glm::normalize(glm::dvec3((hill(x - kStep, z) - hill(x + kStep, z)) / (2 * kStep), -1.0,
                                  (hill(x, z - kStep) - hill(x, z + kStep)) / (2 * kStep)));
    const double mottle = lattice_noise({9 * x, 3, 9 * z});
    const double fine = lattice_noise({40 * x, 5, 40 * z});
    const glm::dvec3 grass = blend(glm::dvec3(0.25, 0.38, 0.13), {0.46, 0.50, 0.20}, mottle);
    const glm::dvec3 rock = glm::dvec3(0.45, 0.41, 0.36) * blend(0.6, 1.15, fine);
    const glm::dvec3 sand(0.78, 0.70, 0.53);
    glm::dvec3 rgb = blend(
        grass * blend(0.85, 1.1, fine), rock,
        smooth(0.30, 0.62, 1 + normal.y + 0.25 * (fine - 0.5) + 0.2 * smooth(0.22, 0.1, high)));
    rgb = blend(rgb, sand * blend(0.9, 1.05, fine), smooth(0.05, 0.015, high));
    const double path = std::abs(x - 0.05 - 0.22 * z * z + 0.05 * z);
    const bool on_path = z < -0.15 && high > 0.05;
    rgb = on_path ? blend(rgb, glm::dvec3(0.70, 0.62, 0.48) * blend(0.9, 1.08, fine),
                          smooth(0.075, 0.05, path))
                  : rgb;
    // Wider ones below close the gaps, in which the background would show.
    const bool below = random_.uniform() < 0.35;
    add_lit({x, kSea - high + (below ? 0.012 : 0.0), z}, normal, rgb * (below ? 0.85 : 1.0),
            below ? 2.8 : 1.25, below ? 0.1 : 0.3);
}

void Lighthouse::add_grass() {
    double x = 0;
    double z = 0;
    double high = -1;
    while (high < 0.12 || lattice_noise({3 * x, 11, 3 * z}) < 0.35) {
        x = random_.uniform(-1.3, 1.3);
        z = random_.uniform(-1.2, 1.1);
        high = hill(x, z);
    }
    const double blade = random_.uniform();
    const glm::dvec3 lean = 0.35 * random_.in_ball();
    const glm::dvec3 up = glm::normalize(glm::dvec3(lean.x, -1, lean.z));
    const glm::dvec3 at = glm::dvec3(x, kSea - high, z) + 0.035 * blade * up;
    const glm::dvec3 rgb = blend(glm::dvec3(0.22, 0.33, 0.10), {0.62, 0.62, 0.30}, blade);
    const glm::dvec3 d = random_.direction();
    const glm::dvec3 normal = glm::normalize(d - up * glm::dot(d, up));
    builder_.add(needle_look(), at, normal, rgb + 0.05 * random_.in_ball(), 0.8);
}

// Pines: a trunk, and layers of needles.
void Lighthouse::add_tree() {
    struct Tree {
        double x, z, height;
    };
    static constexpr std::array<Tree, 4> kTrees{
        {{-0.55, 0.30, 0.52}, {-0.75, 0.12, 0.38}, {-0.42, 0.55, 0.42}, {0.85, 0.38, 0.36}}};
    const Tree& tree = kTrees.at(static_cast<std::size_t>(random_.uniform() * 4));
    const glm::dvec3 foot(tree.x, ground(tree.x, tree.z), tree.z);
    if (random_.uniform() < 0.06) {
        add_bar(foot, foot - glm::dvec3(0, 0.25 * tree.height, 0), 0.012, {0.32, 0.24, 0.17});
        return;
    }
    const double h = 1 - std::sqrt(random_.uniform()); // low more often
    const double layer = 1 - 0.45 * std::fmod(6 * h, 1.0);
    const double radius = 0.30 * tree.height * (1 - h) * layer;
    const glm::dvec2 c = random_.on_circle();
    const double r = radius * std::sqrt(random_.uniform(0.25, 1));
    const glm::dvec3 at =
        foot + glm::dvec3(r * c.x, -tree.height * blend(0.16, 1, h) + 0.25 * r, r * c.y);
    const double lit =
        0.7 + 0.35 * std::max(0.0, glm::dot(glm::normalize(glm::dvec3(c.x, -0.6, c.y)), to_sun()));
    const glm::dvec3 rgb = lit * blend(glm::dvec3(0.10, 0.22, 0.12), {0.20, 0.38, 0.17},
                                       random_.uniform() * r / std::max(radius, 1e-6));
    const glm::dvec3 normal = random_.direction();
    builder_.add(needle_look(), at, normal, rgb + 0.03 * random_.in_ball(), 0.85);
}

// Waves, smaller and duller far away; foam at the shore.
void Lighthouse::add_sea() {
    double x = 0;
    double z = 0;
    do {
        const double radius = 0.9 * portable_exp(random_.uniform() * portable_log(kFar / 0.9));
        const glm::dvec2 c = random_.on_circle();
        x = radius * c.x;
        z = radius * c.y;
    } while (hill(x, z) > 0.03 || near_a_camera({x, kSea, z}, 0.5));
    const double away = std::sqrt(x * x + z * z);
    const double wave = lattice_noise({x * 6 / (1 + 0.12 * away), 1, z * 12 / (1 + 0.12 * away)});
    const double far = smooth(2, 30, away);
    glm::dvec3 rgb = blend(blend(glm::dvec3(0.07, 0.27, 0.36), {0.20, 0.45, 0.53}, wave),
                           {0.50, 0.63, 0.70}, far);
    const double shore = hill(x, z);
    rgb = blend(rgb, {0.22, 0.52, 0.52}, smooth(-0.045, -0.01, shore));
    rgb = blend(rgb, {0.93, 0.95, 0.95},
                smooth(-0.012, 0.008, shore) * smooth(0.35, 0.7, wave + 0.15));
    const bool below = random_.uniform() < 0.4; // as under the grass
    const glm::dvec3 normal =
        glm::normalize(glm::dvec3(0, -1, 0) + (below ? 0.01 : 0.12) * random_.in_ball());
    builder_.add(far_look(), {x, kSea + (below ? 0.015 : 0.002), z}, normal,
                 (below ? 0.9 : 1.0) * rgb + 0.02 * random_.in_ball(),
                 std::max(away, 1.2) * (below ? blend(2.4, 1.2, far) : 0.75));
}

// A bright horizon below a blue sky, and clouds in it.
void Lighthouse::add_sky() {
    glm::dvec3 d = random_.direction();
    d.y = -std::abs(d.y) * std::sqrt(random_.uniform());
    d = glm::normalize(d);
    const double up = -d.y;
    const double cloud = smooth(0.52, 0.72,
                                0.65 * lattice_noise({4 * d.x, 9 * d.y, 4 * d.z}) +
                                    0.35 * lattice_noise({11 * d.x, 22 * d.y, 11 * d.z}));
    const glm::dvec3 blue =
        blend(glm::dvec3(0.80, 0.87, 0.92), {0.25, 0.50, 0.83}, smooth(0.0, 0.55, up));
    if (cloud > 0.25 && up > 0.05 && random_.uniform() < 0.5) {
        const glm::dvec3 white =
            blend(glm::dvec3(0.84, 0.86, 0.90), {1.0, 0.99, 0.97}, random_.uniform());
        builder_.add(cloud_look(), 0.8 * kFar * d, glm::normalize(-d + 0.3 * random_.in_ball()),
                     white, 0.8 * kFar * 0.8);
        return;
    }
    const glm::dvec3 normal = glm::normalize(-d + 0.2 * random_.in_ball());
    const glm::dvec3 rgb = blend(blue, glm::dvec3(0.97), 0.75 * cloud);
    builder_.add(far_look(), kFar * d, normal, rgb + 0.01 * random_.in_ball(), 1.7 * kFar);
}

} // namespace degs
