// SPDX-License-Identifier: Apache-2.0
// Profile `lighthouse`: what people have built, and the scene as a whole.
#include <algorithm>
#include <array>
#include <cmath>

#include "scene/synthetic/synthetic_lighthouse.hpp"
#include "scene/synthetic/synthetic_noise.hpp"

namespace degs {
namespace {

using Axis = MeasuredDistribution::Axis;

constexpr double kTowerHeight = 1.05;
constexpr double kTowerFoot = 0.155, kTowerTop = 0.10; ///< radii

/// Opaque and sharp, as flowers and seal have them.
const SyntheticLook& surface_look() {
    static const SyntheticLook look{
        {Axis::Logarithmic, {0.0010, 0.0032, 0.0062, 0.0135, 0.030, 0.09}},
        {Axis::Logarithmic, {1, 1.25, 2.3, 7, 18, 90}},
        {Axis::Logarithmic, {1, 1.8, 6, 18, 60, 500}},
        {Axis::Linear, {0.01, 0.16, 0.72, 0.985, 0.997, 1}},
        0.06F,
    };
    return look;
}

} // namespace

glm::dvec3 Lighthouse::to_sun() {
    static const glm::dvec3 direction = glm::normalize(glm::dvec3(-0.48, -0.68, -0.55));
    return direction;
}

void Lighthouse::add_lit(const glm::dvec3& at, const glm::dvec3& normal, const glm::dvec3& rgb,
                         double scale, double rough) {
    const double light = 0.62 + 0.46 * std::max(0.0, glm::dot(normal, to_sun()));
    const glm::dvec3 tilted = glm::normalize(normal + rough * random_.in_ball());
    const double height = 0.003 * random_.uniform(-1, 1);
    const glm::dvec3 shade = light * rgb + 0.03 * random_.in_ball();
    builder_.add(surface_look(), at + height * normal, tilted, shade, scale);
}

void Lighthouse::add_bar(const glm::dvec3& from, const glm::dvec3& to, double radius,
                         const glm::dvec3& rgb) {
    const glm::dvec3 along = to - from;
    const glm::dvec3 out = random_.direction();
    const glm::dvec3 side =
        glm::normalize(out - along * (glm::dot(out, along) / glm::dot(along, along)));
    const double place = random_.uniform();
    const double length = std::sqrt(glm::dot(along, along));
    // The longest axis lies along the bar: from x, the first axis, to its direction.
    const glm::dvec3 d = along / length;
    glm::dvec4 turn(1 + d.x, 0, -d.z, d.y);
    turn = d.x < -0.99999 ? glm::dvec4(0, 0, 1, 0) : turn / std::sqrt(glm::dot(turn, turn));
    const double size = builder_.size_factor() * random_.uniform(0.006, 0.016);
    const double thin = std::min(0.7 * radius, 0.4 * size);
    const double light = 0.75 + 0.3 * std::max(0.0, -side.y);
    const double opacity = random_.uniform(0.4, 0.99);
    const glm::dvec3 shade = light * rgb + 0.03 * random_.in_ball();
    builder_.add_exact(from + place * along + 0.6 * radius * side, {size, thin, 0.5 * thin}, turn,
                       opacity, shade, 0.03F);
}

glm::dvec3 Lighthouse::in_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    double u = random_.uniform();
    double v = random_.uniform();
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    return a + u * (b - a) + v * (c - a);
}

bool Lighthouse::near_a_camera(const glm::dvec3& at, double distance) const {
    return std::any_of(cameras_.begin(), cameras_.end(), [&](const Camera& camera) {
        return glm::length(camera.position - at) < distance;
    });
}

// White with red bands, a door and windows; weathered towards its foot.
void Lighthouse::add_tower() {
    const double t = 1 - std::sqrt(1 - 0.75 * random_.uniform()); // more where it is wider
    const double height = std::min(1.0, 2 * t);
    const double radius = blend(kTowerFoot, kTowerTop, height);
    const glm::dvec2 c = random_.on_circle();
    const double y = ground(0, 0) + 0.02 - (kTowerHeight + 0.02) * height;
    const auto band = static_cast<int>(height * 5);
    glm::dvec3 rgb = band % 2 == 1 ? glm::dvec3(0.80, 0.13, 0.10) : glm::dvec3(0.93, 0.92, 0.88);
    rgb *= blend(0.86, 1.04, lattice_noise({14 * c.x, 30 * height, 14 * c.y}));
    rgb = blend(rgb, {0.45, 0.44, 0.36}, 0.5 * smooth(0.16, 0.0, height));
    const bool front = c.y < -0.82; // towards the cameras
    const double across = c.x;
    const bool door = front && height < 0.13 && std::abs(across) < 0.30;
    const double pane = height * 5 - band;
    const bool window = front && band >= 1 && pane > 0.32 && pane < 0.68 && std::abs(across) < 0.18;
    if (door || window) {
        rgb = door ? glm::dvec3(0.30, 0.19, 0.12) : glm::dvec3(0.12, 0.15, 0.20);
    }
    add_lit({radius * c.x, y, radius * c.y}, {c.x, -0.05, c.y}, rgb, 0.62, 0.12);
}

// Gallery with a rail, glass with bars and the light in it, and a roof.
void Lighthouse::add_lantern() {
    const double floor = ground(0, 0) - kTowerHeight;
    const double part = random_.uniform();
    const glm::dvec2 c = random_.on_circle();
    constexpr double kGallery = 0.155, kGlass = 0.075, kRoof = 0.105;
    if (part < 0.22) { // the gallery: its floor and its edge
        const bool edge = random_.uniform() < 0.35;
        const double r = edge ? kGallery : kGallery * std::sqrt(random_.uniform());
        const double y = edge ? floor - 0.03 * random_.uniform() : floor - 0.03;
        add_lit({r * c.x, y, r * c.y}, edge ? glm::dvec3(c.x, 0, c.y) : glm::dvec3(0, -1, 0),
                {0.30, 0.31, 0.33}, 0.5);
    } else if (part < 0.36) { // the rail and its posts
        const double post = random_.uniform();
        const glm::dvec3 at(kGallery * c.x, floor - 0.03, kGallery * c.y);
        const glm::dvec3 up(0, -0.055, 0);
        if (post < 0.5) {
            // Posts stand at points of the circle with equal steps of its half angle's tangent.
            const double step = (std::floor(random_.uniform() * 12) - 5.5) / 5.5;
            const double sign = random_.uniform() < 0.5 ? -1 : 1;
            const double q = 1 + step * step;
            const glm::dvec3 foot(kGallery * 2 * step / q, floor - 0.03,
                                  sign * kGallery * (1 - step * step) / q);
            add_bar(foot, foot + up, 0.004, {0.25, 0.25, 0.27});
        } else {
            const double high = post < 0.75 ? 1.0 : 0.5;
            const glm::dvec3 along(-0.012 * c.y, 0, 0.012 * c.x);
            add_bar(at + high * up - along, at + high * up + along, 0.003, {0.25, 0.25, 0.27});
        }
    } else if (part < 0.66) { // glass with dark bars, bright inside
        const double y = floor - 0.03 - 0.14 * random_.uniform();
        const bool light = random_.uniform() < 0.45;
        const double r = light ? 0.03 : kGlass;
        const double bar = std::abs(std::fmod(8 * (c.x + 1), 2.0) - 1);
        const glm::dvec3 glass = bar < 0.2 ? glm::dvec3(0.2, 0.2, 0.2) : glm::dvec3(0.98, 0.9, 0.6);
        builder_.add(surface_look(), {r * c.x, y, r * c.y},
                     glm::normalize(glm::dvec3(c.x, 0, c.y) + 0.15 * random_.in_ball()),
                     light ? glm::dvec3(1.25, 1.1, 0.65) : glass, 0.45);
    } else { // the roof, and a ball on it
        const bool ball = random_.uniform() < 0.06;
        const double h = std::sqrt(random_.uniform());
        const glm::dvec3 d = random_.direction();
        const glm::dvec3 tip(0, floor - 0.27, 0);
        add_lit(ball ? tip + 0.016 * d
                     : glm::dvec3(kRoof * h * c.x, tip.y + 0.1 * h, kRoof * h * c.y),
                ball ? d : glm::normalize(glm::dvec3(c.x, -1, c.y)), {0.62, 0.10, 0.09}, 0.5);
    }
}

// White walls with windows and a door, and a roof of slates.
void Lighthouse::add_house() {
    constexpr double kHalfX = 0.19, kHalfZ = 0.12, kWall = 0.15, kRidge = 0.115;
    const glm::dvec3 at(0.45, ground(0.45, 0.12) + 0.025, 0.12);
    const double part = random_.uniform();
    if (part < 0.52) {
        const double u = random_.uniform(-1, 1);
        const double v = random_.uniform();
        const double face = random_.uniform();
        const bool long_side = face < 0.62;
        const double side = random_.uniform() < 0.5 ? -1 : 1;
        const glm::dvec3 normal = long_side ? glm::dvec3(0, 0, side) : glm::dvec3(side, 0, 0);
        const glm::dvec3 place = long_side ? glm::dvec3(u * kHalfX, -v * kWall, side * kHalfZ)
                                           : glm::dvec3(side * kHalfX, -v * kWall, u * kHalfZ);
        glm::dvec3 rgb = glm::dvec3(0.90, 0.88, 0.82) *
                         blend(0.88, 1.04, lattice_noise(glm::dvec3(25.0) * place));
        const double column = std::abs(std::fmod(3 * (u + 1) / 2, 1.0) - 0.5);
        const bool middle = std::abs(u) < 1.0 / 3;
        const bool door = long_side && middle && v < 0.62 && column < 0.17;
        const bool window = (!long_side || !middle) && v > 0.36 && v < 0.74 && column < 0.2;
        rgb = door ? glm::dvec3(0.16, 0.33, 0.30) : window ? glm::dvec3(0.16, 0.21, 0.27) : rgb;
        add_lit(at + place, normal, rgb, 0.6, 0.12);
    } else if (part < 0.60) { // gables
        const double side = random_.uniform() < 0.5 ? -1 : 1;
        const glm::dvec3 place =
            in_triangle({side * kHalfX, -kWall, -kHalfZ}, {side * kHalfX, -kWall, kHalfZ},
                        {side * kHalfX, -kWall - kRidge, 0});
        add_lit(at + place, {side, 0, 0}, {0.90, 0.88, 0.82}, 0.6, 0.12);
    } else if (part < 0.95) {
        const double side = random_.uniform() < 0.5 ? -1 : 1;
        const double u = random_.uniform(-1, 1);
        const double h = random_.uniform();
        const glm::dvec3 place(1.08 * kHalfX * u, -kWall - kRidge + kRidge * 1.12 * h,
                               side * 1.12 * kHalfZ * h);
        const double slate = lattice_noise({60 * place.x, 40 * h, 60 * side});
        add_lit(at + place, glm::normalize(glm::dvec3(0, -1, side * 0.95)),
                glm::dvec3(0.31, 0.34, 0.40) * blend(0.7, 1.2, slate), 0.62, 0.15);
    } else { // the chimney
        const glm::dvec3 d = random_.direction();
        const double m = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        const glm::dvec3 place = d / m * glm::dvec3(0.022, 0.05, 0.022);
        const glm::dvec3 normal = std::abs(d.x) == m   ? glm::dvec3(d.x / m, 0, 0)
                                  : std::abs(d.z) == m ? glm::dvec3(0, 0, d.z / m)
                                                       : glm::dvec3(0, d.y / m, 0);
        add_lit(at + glm::dvec3(-0.11, -kWall - kRidge - 0.01, 0) + place, normal,
                {0.60, 0.32, 0.25}, 0.5);
    }
}

// Posts and two rails along the edge of the plateau.
void Lighthouse::add_fence() {
    constexpr int kPosts = 26;
    const auto post_at = [](double number) {
        const double x = -1.02 + 1.95 * number / (kPosts - 1);
        const double z = -0.62 + 0.32 * x * x - 0.10 * x;
        return glm::dvec3(x, ground(x, z), z);
    };
    const glm::dvec3 wood = glm::dvec3(0.60, 0.53, 0.43) * random_.uniform(0.85, 1.1);
    const auto first = static_cast<int>(random_.uniform() * (kPosts - 1));
    const glm::dvec3 foot = post_at(first);
    if (random_.uniform() < 0.4) {
        add_bar(foot + glm::dvec3(0, 0.01, 0), foot - glm::dvec3(0, 0.095, 0), 0.008, wood);
        return;
    }
    const double rail = random_.uniform() < 0.5 ? 0.045 : 0.08;
    const glm::dvec3 next = post_at(first + 1);
    add_bar(foot - glm::dvec3(0, rail, 0), next - glm::dvec3(0, rail, 0), 0.005, wood);
}

// A sailing boat off the headland.
void Lighthouse::add_boat() {
    const glm::dvec3 at(-2.3, kSea, 1.9);
    const double part = random_.uniform();
    if (part < 0.35) { // hull: a half ellipsoid
        const glm::dvec3 d = random_.direction();
        const glm::dvec3 place(0.30 * d.x, -0.05 + 0.08 * std::abs(d.y), 0.09 * d.z);
        const glm::dvec3 rgb =
            std::abs(d.y) < 0.35 ? glm::dvec3(0.93, 0.93, 0.92) : glm::dvec3(0.13, 0.22, 0.42);
        add_lit(at + place, glm::normalize(glm::dvec3(d.x, 0.4 * std::abs(d.y), 3 * d.z)), rgb,
                1.1);
    } else if (part < 0.42) {
        add_bar(at + glm::dvec3(0.02, 0, 0), at + glm::dvec3(0.02, -0.82, 0), 0.008,
                {0.45, 0.34, 0.24});
    } else {
        const bool jib = part < 0.62;
        const glm::dvec3 place =
            jib ? in_triangle({0.05, -0.72, 0}, {0.07, -0.10, 0}, {0.30, -0.08, 0})
                : in_triangle({0.0, -0.80, 0}, {0.0, -0.12, 0}, {-0.28, -0.12, 0});
        add_lit(at + place + glm::dvec3(0, 0, -0.12 * (place.y + 0.8) * place.x), {0.1, -0.1, -1},
                {0.97, 0.95, 0.90}, 1.1, 0.1);
    }
}

void make_lighthouse(const SyntheticSpec& spec, SyntheticScene& scene) {
    scene.cameras = synthetic_cameras({{{{1.75, -0.50, -2.75}, {0.02, -0.22, 0}, 0.8},
                                        {{-1.75, -0.42, -2.1}, {0.05, -0.20, 0}, 0.85},
                                        {{0.72, -0.30, -1.65}, {0.14, -0.26, 0}, 0.85}}});
    SyntheticBuilder builder(scene.cloud, spec, 3);
    Lighthouse lighthouse(builder, scene.cameras);
    struct Part {
        double until; ///< of the Gaussians
        void (Lighthouse::*add)();
    };
    static constexpr std::array<Part, 10> kParts{{{0.14, &Lighthouse::add_tower},
                                                  {0.19, &Lighthouse::add_lantern},
                                                  {0.27, &Lighthouse::add_house},
                                                  {0.54, &Lighthouse::add_hill},
                                                  {0.63, &Lighthouse::add_grass},
                                                  {0.67, &Lighthouse::add_fence},
                                                  {0.73, &Lighthouse::add_tree},
                                                  {0.75, &Lighthouse::add_boat},
                                                  {0.91, &Lighthouse::add_sea},
                                                  {1.00, &Lighthouse::add_sky}}};
    for (std::uint64_t i = 0; i < spec.gaussians; ++i) {
        const double share = builder.random().uniform();
        const auto part = std::find_if(kParts.begin(), kParts.end() - 1,
                                       [share](const Part& p) { return share < p.until; });
        (lighthouse.*part->add)();
    }
}

} // namespace degs
