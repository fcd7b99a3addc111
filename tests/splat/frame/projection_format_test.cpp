// SPDX-License-Identifier: Apache-2.0
// The projection in other formats than double.
#include <algorithm>
#include <cmath>

#include "splat/frame/projection.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

using test::add_gaussian;
using test::make_camera;

ProjectionOptions in(const std::string& format) {
    ProjectionOptions options;
    options.numbers.format = parse_format(format);
    return options;
}

/// A camera that is turned and away from the origin.
Camera turned_camera() {
    Camera camera = make_camera(1280, 720, 900);
    camera.fy = 850;
    camera.position = {0.3, -0.2, -0.5};
    camera.camera_to_world =
        glm::dmat3(test::rotation_matrix(glm::normalize(glm::vec4(1, 0.1F, -0.2F, 0.3F))));
    return camera;
}

/// Bounds on the error of a splat, first order in the unit u of the format, from the number of
/// roundings on the way to each value and the sizes of what they round.
struct Bounds {
    double mu_x, mu_y, cov_a, cov_b, cov_c, det, q, depth;

    Bounds(const GaussianCloud& cloud, std::size_t i, const Camera& camera,
           const ProjectedSplat& exact, double u) {
        const glm::dvec3 offset = cloud.means[i] - camera.position;
        const double length = glm::length(offset);
        const double z = exact.depth;
        // Both factors of three products rounded, the products, two sums.
        const double view = 5 * u * length;
        depth = view;
        // f x / z of a rounded x, z and f with two roundings; two sums on the way to the pixel.
        const auto mean = [&](double x, double focal, int pixels) {
            const double m = focal * x / z;
            return focal * view * (1 + std::abs(x / z)) / z + 3 * u * std::abs(m) +
                   2 * u * (std::abs(m) + pixels);
        };
        const double x = glm::dot(camera.camera_to_world[0], offset);
        const double y = glm::dot(camera.camera_to_world[1], offset);
        mu_x = mean(x, camera.fx, camera.width);
        mu_y = mean(y, camera.fy, camera.height);
        // A row of J Rv: slopes of x and z, products, sum, f/z: 11 u and 10 view/z of its length;
        // the rotation's entries, up to 1, are off by 12 u, sums of three of them by 36 u, products
        // and sums with the row by 9 u; then a product with a scale.
        const glm::dvec3 scale(cloud.scales[i]);
        const double most = std::sqrt(3.0) * std::max({scale.x, scale.y, scale.z});
        const double relative = 56 * u + 10 * view / z;
        const double du = most * camera.fx / z * (1 + std::abs(x / z)) * relative;
        const double dv = most * camera.fy / z * (1 + std::abs(y / z)) * relative;
        const double a = std::sqrt(exact.cov_a);
        const double c = std::sqrt(exact.cov_c);
        cov_b = a * dv + c * du + 5 * u * a * c;
        cov_c = 2 * c * dv + 5 * u * exact.cov_c;
        const double normal = std::sqrt(exact.det);
        const double dnormal = du * c + dv * a + 5 * u * a * c;
        det = 2 * normal * dnormal + dnormal * dnormal +
              0.3 * (2 * a * du + 5 * u * exact.cov_a + cov_c) + 10 * u * exact.det;
        // (det + b^2) / c.
        cov_a = (det + 2 * std::abs(exact.cov_b) * cov_b + exact.cov_a * cov_c) / exact.cov_c;
        // Opacity, 1/255 and the quotient change the logarithm by u each, which is then rounded.
        q = 2 * 3 * u + u * exact.q_threshold;
    }
};

/// The largest error of any value, in bounds; the number of splats compared.
struct Worst {
    double ratio = 0;
    int compared = 0;

    void add(double error, double bound) { ratio = std::max(ratio, std::abs(error) / bound); }
};

Worst compare(const GaussianCloud& cloud, const std::string& format, double u) {
    const Camera camera = turned_camera();
    const auto exact = make_projector(cloud, camera, {});
    const auto rounded = make_projector(cloud, camera, in(format));
    Worst worst;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        ProjectedSplat a;
        ProjectedSplat b;
        if (exact->project_anywhere(i, a) != Cull::None || a.depth < 0.3 || a.q_threshold < 0.01) {
            continue; // what rounding may drop
        }
        EXPECT_EQ(rounded->project_anywhere(i, b), Cull::None);
        const Bounds bounds(cloud, i, camera, a, 1.01 * u);
        worst.add(b.mu_x - a.mu_x, bounds.mu_x);
        worst.add(b.mu_y - a.mu_y, bounds.mu_y);
        worst.add(b.cov_a - a.cov_a, bounds.cov_a);
        worst.add(b.cov_b - a.cov_b, bounds.cov_b);
        worst.add(b.cov_c - a.cov_c, bounds.cov_c);
        worst.add(b.det - a.det, bounds.det);
        worst.add(b.q_threshold - a.q_threshold, bounds.q);
        worst.add(b.depth - a.depth, bounds.depth);
        EXPECT_NEAR(b.opacity, std::exp(b.q_threshold / 2) / 255, 1e-15);
        ++worst.compared;
    }
    return worst;
}

TEST(ProjectionFormat, SinglePrecisionIsAsNearAsItsRoundings) {
    const GaussianCloud cloud = test::random_cloud(3000, 21);
    const double unit = std::ldexp(1.0, -24);
    const Worst worst = compare(cloud, "fp32", unit);
    EXPECT_GT(worst.compared, 2000);
    EXPECT_LT(worst.ratio, 1);
    EXPECT_GT(worst.ratio, 0.05); // the bounds are not far off
    EXPECT_GT(compare(cloud, "e8m20", unit).ratio, 1);
    EXPECT_LT(compare(cloud, "e8m20", 8 * unit).ratio, 1);
}

TEST(ProjectionFormat, ColourIsAsNearAsItsRoundings) {
    const GaussianCloud cloud = test::random_cloud(500, 22, 3);
    const Camera camera = turned_camera();
    const double unit = std::ldexp(1.0, -24);
    double worst = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        ProjectedSplat a;
        ProjectedSplat b;
        shade(cloud, i, camera, a);
        shade(cloud, i, camera, b, in("fp32"));
        double sum = 0;
        for (int k = 0; k < 48; ++k) {
            sum += std::abs(double{cloud.sh_of(i)[k]});
        }
        // A direction is off by 7 u. The steepest Y_k is 2.9 x y z, or a difference of squares, up
        // to 4, times 1.45: within 120 u; 18 roundings of terms below 0.75 c_k follow.
        for (int c = 0; c < 3; ++c) {
            worst = std::max(worst, std::abs(a.colour[c] - b.colour[c]) / (unit * 134 * (sum + 1)));
        }
    }
    EXPECT_LT(worst, 1);
    EXPECT_GT(worst, 0.002);
}

TEST(ProjectionFormat, RoundingAfterEveryOperationIsTheMachinesFloat) {
    const GaussianCloud cloud = test::random_cloud(2000, 23, 3);
    const Camera camera = turned_camera();
    const auto machine = make_projector(cloud, camera, in("fp32"));
    const auto rounding = make_rounding_projector(cloud, camera, in("fp32"));
    int compared = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        ProjectedSplat a;
        ProjectedSplat b;
        const Cull cull = machine->project(i, a);
        ASSERT_EQ(rounding->project(i, b), cull);
        if (cull != Cull::None) {
            continue;
        }
        EXPECT_EQ(machine->shade(i, a), rounding->shade(i, b));
        EXPECT_EQ(a.mu_x, b.mu_x);
        EXPECT_EQ(a.mu_y, b.mu_y);
        EXPECT_EQ(a.cov_a, b.cov_a);
        EXPECT_EQ(a.cov_b, b.cov_b);
        EXPECT_EQ(a.cov_c, b.cov_c);
        EXPECT_EQ(a.det, b.det);
        EXPECT_EQ(a.q_threshold, b.q_threshold);
        EXPECT_EQ(a.depth, b.depth);
        for (int c = 0; c < 3; ++c) {
            EXPECT_EQ(a.colour[c], b.colour[c]);
        }
        ++compared;
    }
    EXPECT_GT(compared, 500);
}

// In fp32, a c - b^2 of a needle is off by as much as det.
TEST(ProjectionFormat, SplatsAreOneEllipse) {
    GaussianCloud cloud;
    add_gaussian(cloud, {0.1, 0.2, 5}, {200, 0.01F, 0.01F}, test::turn_about_z(0.7), 0.5F,
                 glm::vec3(0.5F));
    for (const std::string format : {"fp32", "e8m16"}) {
        ProjectedSplat splat;
        const Camera camera = make_camera(64, 48, 100);
        ASSERT_EQ(project(cloud, 0, camera, in(format), splat), Cull::None);
        const double cancelled = splat.cov_a * splat.cov_c - splat.cov_b * splat.cov_b;
        EXPECT_GT(splat.cov_a, 1e6);
        EXPECT_NEAR(cancelled / splat.det, 1, 1e-6) << format;
    }
}

// H23: only what lies near the camera is rounded.
TEST(ProjectionFormat, LargeWorldOffsetChangesNothing) {
    for (const std::string format : {"fp32", "fp16", "q12.12"}) {
        ProjectedSplat home;
        for (const double offset : {0.0, 131072.0, 8388608.0}) {
            GaussianCloud cloud;
            add_gaussian(cloud, glm::dvec3(offset) + glm::dvec3(0.25, -0.125, 5), glm::vec3(0.125F),
                         {1, 0, 0, 0}, 0.5F, glm::vec3(0.5F));
            Camera camera = make_camera(64, 48, 100);
            camera.position = glm::dvec3(offset);
            ProjectedSplat splat;
            ASSERT_EQ(project(cloud, 0, camera, in(format), splat), Cull::None) << format;
            home = offset == 0 ? splat : home;
            EXPECT_EQ(splat.mu_x, home.mu_x);
            EXPECT_EQ(splat.det, home.det);
            EXPECT_EQ(splat.depth, 5);
        }
    }
}

/// An isotropic splat of `sigma` px, 5 units away.
Cull project_disc(double sigma, const std::string& format) {
    GaussianCloud cloud;
    add_gaussian(cloud, {0, 0, 5}, glm::vec3(static_cast<float>(sigma * 5 / 100)), {1, 0, 0, 0},
                 0.5F, glm::vec3(0.5F));
    ProjectedSplat splat;
    return project(cloud, 0, make_camera(64, 48, 100), in(format), splat);
}

// det = (sigma^2 + 0.3)^2 fits a format up to the fourth root of its largest value.
TEST(ProjectionFormat, WhatOverflowsIsDegenerate) {
    for (const std::string format : {"fp16", "q18.12", "e6m9"}) {
        const double most = std::sqrt(std::sqrt(parse_format(format).max()) - 0.3);
        EXPECT_EQ(project_disc(0.95 * most, format), Cull::None) << format;
        EXPECT_EQ(project_disc(1.05 * most, format), Cull::Degenerate) << format;
    }
    EXPECT_EQ(project_disc(1e9, "fp32"), Cull::None); // 10^36
    EXPECT_EQ(project_disc(1e10, "fp32"), Cull::Degenerate);
    EXPECT_EQ(project_disc(1e10, "fp64"), Cull::None);
}

TEST(ProjectionFormat, OverflowsAreCountedAndLeaveNoMark) {
    GaussianCloud cloud;
    const glm::vec4 straight(1, 0, 0, 0);
    const glm::vec3 small(0.05F);
    add_gaussian(cloud, {0, 0, 5}, small, straight, 0.5F, glm::vec3(0.5F));
    add_gaussian(cloud, {0, 0, 1e5}, small, straight, 0.5F, glm::vec3(0.5F));      // offset
    add_gaussian(cloud, {0, 0, 5}, glm::vec3(5), straight, 0.5F, glm::vec3(0.5F)); // determinant
    add_gaussian(cloud, {0, 0, 5}, small, straight, 0.5F, {1e5F, 0, 0});           // colour
    add_gaussian(cloud, {0, 0, -1}, small, straight, 0.5F, glm::vec3(0.5F));
    for (const TileMode mode :
         {TileMode::Exact, TileMode::Square, TileMode::Box, TileMode::Tight}) {
        const FrameWorkload work =
            make_frame_workload(cloud, make_camera(64, 48, 100), 16, mode, in("fp16"));
        EXPECT_EQ(work.culled.degenerate, 3U);
        EXPECT_EQ(work.culled.near, 1U);
        ASSERT_EQ(work.splats.size(), 1U);
        EXPECT_EQ(work.tile_pairs(), work.tiles_touched[0]);
        for (const ProjectedSplat& splat : work.splats) {
            EXPECT_TRUE(std::isfinite(splat.colour[0] + splat.det + splat.mu_x));
        }
    }
}

// Lists and order follow from the rounded splats.
TEST(ProjectionFormat, EqualDepthsOfTheFormatKeepTheOrderOfTheCloud) {
    GaussianCloud cloud;
    for (const double z : {5.001, 5.0, 4.0}) { // fp16 has a unit of 1/256 there
        add_gaussian(cloud, {0, 0, z}, glm::vec3(0.1F), {1, 0, 0, 0}, 0.5F, glm::vec3(0.5F));
    }
    const Camera camera = make_camera(64, 48, 100);
    const auto order = [&](const std::string& format) {
        std::vector<std::uint32_t> ids;
        for (const ProjectedSplat& splat :
             make_frame_workload(cloud, camera, 16, TileMode::Exact, in(format)).splats) {
            ids.push_back(splat.id);
        }
        return ids;
    };
    EXPECT_EQ(order("fp64"), (std::vector<std::uint32_t>{2, 1, 0}));
    EXPECT_EQ(order("fp16"), (std::vector<std::uint32_t>{2, 0, 1}));
}

} // namespace
} // namespace degs
