// SPDX-License-Identifier: Apache-2.0
// Projection by sigma points against Monte Carlo.
#include <cstdio>

#include "tests/splat/frame/lens_views.hpp"

namespace degs {
namespace {

using test::add_gaussian;
using test::all_lenses;
using test::in_world;
using test::kPinhole;
using test::make_camera;
using test::published_lenses;
using test::PublishedLens;
using test::turned_camera;
using test::unscented;

/// Mean and covariance of many projected samples of a Gaussian, in double.
struct Sampled {
    glm::dvec2 mean{0.0};
    double a = 0, b = 0, c = 0;
};

/// Samples come in pairs on both sides of the mean, so that odd terms cancel.
Sampled sampled(const PublishedLens& lens, const Camera& camera, const GaussianCloud& cloud,
                int pairs, std::mt19937& random) {
    std::normal_distribution<double> normal;
    const test::Matrix turn = test::rotation_matrix(cloud.rotations[0]);
    const glm::dmat3 to_view = glm::transpose(camera.camera_to_world);
    const glm::dvec3 mean = to_view * (cloud.means[0] - camera.position);
    const glm::dvec4 intrinsics(camera.fx, camera.fy, 0.5 * camera.width, 0.5 * camera.height);
    const glm::dvec2 middle = lens.pixel_of(mean, intrinsics);
    glm::dvec2 sum(0.0);
    Sampled all;
    for (int i = 0; i < pairs; ++i) {
        const glm::dvec3 own(cloud.scales[0].x * normal(random), cloud.scales[0].y * normal(random),
                             cloud.scales[0].z * normal(random));
        const glm::dvec3 step = to_view * (glm::dmat3(turn) * own);
        for (const double sign : {1.0, -1.0}) {
            const glm::dvec2 d = lens.pixel_of(mean + sign * step, intrinsics) - middle;
            sum += d;
            all.a += d.x * d.x;
            all.b += d.x * d.y;
            all.c += d.y * d.y;
        }
    }
    const double n = 2.0 * pairs;
    const glm::dvec2 offset = sum / n;
    all.mean = middle + offset - 0.5;
    all.a = all.a / n - offset.x * offset.x;
    all.b = all.b / n - offset.x * offset.y;
    all.c = all.c / n - offset.y * offset.y;
    return all;
}

// Sizes of up to a fiftieth of the depth. With s = size / depth, the unscented mean is exact to
// s^2 (it matches moments up to the third), so that it is off by about 3 s^4 f times derivatives
// of the map, below 40 here; the first order cancels in pairs of samples, and the second scatters
// by up to 6 s sigma / sqrt(pairs). The covariance is exact to s^2, and off by about 40 s^2 of its
// trace; samples scatter by sqrt(2 / pairs) of it. Five standard deviations.
TEST(UnscentedMonteCarlo, MeanAndCovarianceAgreeOnAThousandGaussians) {
    constexpr int kPairs = 1000;
    std::mt19937 random(17);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const std::vector<PublishedLens> lenses = all_lenses();
    ProjectionOptions bare = unscented();
    bare.dilation = 0;
    int compared = 0;
    for (int i = 0; compared < 1000; ++i) {
        const PublishedLens& lens = lenses[i % lenses.size()];
        const Camera camera = turned_camera(lens);
        const double z = 4 + 2 * uniform(random);
        const glm::dvec3 seen(0.6 * z * uniform(random), 0.35 * z * uniform(random), z);
        const double s = 0.02 * std::exp(1.5 * (uniform(random) - 1)); // 0.001 to 0.02
        GaussianCloud cloud;
        const auto size = static_cast<float>(s * z);
        add_gaussian(cloud, in_world(camera, seen),
                     glm::vec3(size, size * (0.55 + 0.45 * uniform(random)), 0.3F * size),
                     test::random_rotation(random), 1, test::kGrey);
        ProjectedSplat splat;
        if (project_anywhere(cloud, 0, camera, bare, splat) != Cull::None) {
            continue; // behind a fold
        }
        const Sampled wanted = sampled(lens, camera, cloud, kPairs, random);
        const double trace = wanted.a + wanted.c;
        const double mean =
            40 * 3 * s * s * s * s * camera.fx + 5 * 6 * s * std::sqrt(trace) / std::sqrt(kPairs);
        EXPECT_NEAR(splat.mu_x, wanted.mean.x, mean) << lens.name << ' ' << s;
        EXPECT_NEAR(splat.mu_y, wanted.mean.y, mean) << lens.name << ' ' << s;
        const double covariance = (40 * s * s + 5 * std::sqrt(2.0 / kPairs)) * trace;
        EXPECT_NEAR(splat.cov_a, wanted.a, covariance) << lens.name << ' ' << s;
        EXPECT_NEAR(splat.cov_b, wanted.b, covariance) << lens.name << ' ' << s;
        EXPECT_NEAR(splat.cov_c, wanted.c, covariance) << lens.name << ' ' << s;
        ++compared;
    }
}

/// Mean errors of a projection against samples.
struct Errors {
    double mean_px = 0, covariance = 0;
};

/// Twenty Gaussians of one size, in units of their depth, at one angle to the view axis; the
/// covariance's error is relative, in the Frobenius norm.
Errors errors_of(const PublishedLens& lens, ProjectionRule rule, double size, double degrees) {
    constexpr int kGaussians = 20, kPairs = 5000;
    std::mt19937 random(23);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Camera camera = make_camera(4000, 4000, 1000);
    camera.lens = lens.lens();
    ProjectionOptions options;
    options.rule = rule;
    options.dilation = 0;
    Errors sum;
    for (int i = 0; i < kGaussians; ++i) {
        const double around = test::kPi * uniform(random);
        const double slope = std::tan(degrees * test::kPi / 180);
        GaussianCloud cloud;
        const auto scale = static_cast<float>(4 * size);
        add_gaussian(cloud, {4 * slope * std::cos(around), 4 * slope * std::sin(around), 4},
                     {scale, 0.6F * scale, 0.3F * scale}, test::random_rotation(random), 1,
                     test::kGrey);
        const Sampled wanted = sampled(lens, camera, cloud, kPairs, random);
        ProjectedSplat splat;
        EXPECT_EQ(project_anywhere(cloud, 0, camera, options, splat), Cull::None);
        sum.mean_px += std::hypot(splat.mu_x - wanted.mean.x, splat.mu_y - wanted.mean.y);
        const auto norm = [](double a, double b, double c) {
            return std::sqrt(a * a + 2 * b * b + c * c);
        };
        sum.covariance +=
            norm(splat.cov_a - wanted.a, splat.cov_b - wanted.b, splat.cov_c - wanted.c) /
            norm(wanted.a, wanted.b, wanted.c);
    }
    return {sum.mean_px / kGaussians, sum.covariance / kGaussians};
}

// Prints the table of docs/rendering-rules.md. Sigma points are nearer to the samples than the
// Jacobian wherever its error is beyond their scatter.
TEST(LongUnscentedMonteCarlo, TableOfErrors) {
    std::printf("| size / depth | angle | linear | unscented | unscented, fisheye |\n");
    for (const double size : {0.01, 0.03, 0.1}) {
        for (const double degrees : {0.0, 30.0, 55.0}) {
            const Errors linear = errors_of(kPinhole, ProjectionRule::Linear, size, degrees);
            const Errors sigma = errors_of(kPinhole, ProjectionRule::Unscented, size, degrees);
            const Errors fisheye =
                errors_of(published_lenses().back(), ProjectionRule::Unscented, size, degrees);
            std::printf("| %g | %g° | %.2g px, %.2g %% | %.2g px, %.2g %% | %.2g px, %.2g %% |\n",
                        size, degrees, linear.mean_px, 100 * linear.covariance, sigma.mean_px,
                        100 * sigma.covariance, fisheye.mean_px, 100 * fisheye.covariance);
            constexpr double kScatter = 0.03; // sqrt(2 / pairs), of the covariance
            EXPECT_LT(sigma.mean_px, linear.mean_px);
            EXPECT_LT(sigma.covariance, linear.covariance + kScatter);
        }
    }
}

} // namespace
} // namespace degs
