// SPDX-License-Identifier: Apache-2.0
// Projection by sigma points: against the published lenses, against Monte Carlo, against the
// Jacobian, and where points have no projection.
#include "splat/frame/unscented.hpp"

#include <limits>

#include "degs/error.hpp"
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

/// Points of a grid over the image land where OpenCV puts them.
void expect_grid(const PublishedLens& lens, const glm::dvec2& point) {
    Camera camera = turned_camera(lens);
    ASSERT_TRUE(camera.set_principal_point(point));
    const glm::dvec4 intrinsics(camera.fx, camera.fy, point.x, point.y);
    int inside = 0, rim = 0;
    for (double a = -1.4; a <= 1.4; a += 0.05) {
        for (double b = -1.0; b <= 1.0; b += 0.05) {
            const glm::dvec3 seen(5 * a, 5 * b, 5);
            const glm::dvec2 wanted = lens.pixel_of(seen, intrinsics);
            if (std::hypot(a, b) > camera.lens.fold_slope() || wanted.x < 0 || wanted.y < 0 ||
                wanted.x > camera.width || wanted.y > camera.height) {
                continue;
            }
            GaussianCloud cloud;
            add_gaussian(cloud, in_world(camera, seen), glm::vec3(1e-4F), test::kNoTurn, 1,
                         test::kGrey);
            ProjectedSplat splat;
            ASSERT_EQ(project(cloud, 0, camera, unscented(), splat), Cull::None);
            const glm::dvec2 seen_at(splat.mu_x + 0.5 - camera.origin.x,
                                     splat.mu_y + 0.5 - camera.origin.y);
            EXPECT_LT(glm::length(seen_at - wanted), 0.05) << lens.name << ' ' << a << ' ' << b;
            ++inside;
            rim += std::min(
                       {wanted.x, wanted.y, camera.width - wanted.x, camera.height - wanted.y}) < 40
                       ? 1
                       : 0;
        }
    }
    EXPECT_GT(inside, 200) << lens.name;
    EXPECT_GT(rim, 20) << lens.name;
}

TEST(UnscentedLens, GridOfPointsLandsWhereOpenCvPutsIt) {
    for (const PublishedLens& lens : all_lenses()) {
        expect_grid(lens, {640, 360});
        expect_grid(lens, {511.25, 402.5});
    }
}

// The difference falls with the square of the size, down to rounding.
TEST(Unscented, IsLinearInTheLimitOfSmallSplats) {
    const Camera camera = turned_camera(kPinhole);
    const GaussianCloud whole = test::random_cloud(300, 3);
    int compared = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        const double z = glm::dot(camera.camera_to_world[2], whole.means[i] - camera.position);
        double before = std::numeric_limits<double>::infinity();
        for (const double size : {1e-2, 1e-3, 1e-4}) {
            GaussianCloud cloud;
            add_gaussian(cloud, whole.means[i],
                         glm::vec3(static_cast<float>(size * z), static_cast<float>(0.7 * size * z),
                                   static_cast<float>(0.2 * size * z)),
                         whole.rotations[i], 1, test::kGrey);
            ProjectionOptions linear, sigma = unscented();
            linear.dilation = sigma.dilation = 0;
            linear.jacobian_clamp = sigma.jacobian_clamp = 100;
            ProjectedSplat a, b;
            if (project_anywhere(cloud, 0, camera, linear, a) != Cull::None || a.depth < 0.5) {
                continue;
            }
            ASSERT_EQ(project_anywhere(cloud, 0, camera, sigma, b), Cull::None);
            EXPECT_EQ(a.depth, b.depth);
            const double slope = 1 + std::hypot(a.mu_x - 639.5, a.mu_y - 359.5) / 950;
            const double off = 20 * size * size * slope * slope; // relative
            EXPECT_NEAR(a.mu_x, b.mu_x, off * camera.fx * slope);
            EXPECT_NEAR(a.cov_a, b.cov_a, off * (a.cov_a + a.cov_c) + 1e-9);
            EXPECT_NEAR(a.cov_b, b.cov_b, off * (a.cov_a + a.cov_c) + 1e-9);
            EXPECT_NEAR(a.cov_c, b.cov_c, off * (a.cov_a + a.cov_c) + 1e-9);
            const double difference = std::abs(a.mu_x - b.mu_x);
            EXPECT_LE(difference, before + 1e-9);
            before = difference;
            ++compared;
        }
    }
    EXPECT_GT(compared, 500);
}

// The mean of seven points is theirs, weights and all, by the definition of the transform.
TEST(Unscented, WeightsAreThoseOfTheDefinition) {
    SigmaPoints sigma{0.9, 2, 1};
    const double spread = sigma.alpha * sigma.alpha * (3 + sigma.kappa);
    const double lambda = spread - 3;
    EXPECT_NEAR(sigma.distance(), std::sqrt(3 + lambda), 1e-15);
    EXPECT_NEAR(sigma.weight(), 1 / (2 * (3 + lambda)), 1e-15);
    EXPECT_NEAR(sigma.centre_weight(),
                lambda / (3 + lambda) + 1 - sigma.alpha * sigma.alpha + sigma.beta, 1e-15);
    EXPECT_TRUE(sigma.is_sound());
    EXPECT_TRUE(SigmaPoints().is_sound());
    EXPECT_FALSE((SigmaPoints{0.1, 2, 0}.is_sound())); // gsplat's: -96 at the centre
    EXPECT_FALSE((SigmaPoints{0, 2, 0}.is_sound()));
    EXPECT_FALSE((SigmaPoints{1, 2, -3}.is_sound()));
}

// det = a c - b^2 by Cauchy-Binet, also where the difference has no digits left.
TEST(Unscented, NeedleDeterminantKeepsItsDigits) {
    for (const double length : {1e2, 1e3, 1e4}) {
        const double px = 10.0 / 100; // scene units per pixel at z = 10
        GaussianCloud cloud;
        add_gaussian(cloud, {0, 0, 10}, {static_cast<float>(length * px), 0, 0},
                     test::turn_about_z(0.7), 0.5F, test::kGrey);
        Camera camera = make_camera(64, 48, 100);
        ProjectionOptions options = unscented();
        options.jacobian_clamp = 1e6;
        ProjectedSplat splat;
        ASSERT_EQ(project_anywhere(cloud, 0, camera, options, splat), Cull::None);
        const long double l = static_cast<float>(length * px) / px;
        const long double exact = (l * l + 0.3L) * 0.3L;
        EXPECT_NEAR(static_cast<double>(splat.det / exact), 1, 1e-12) << length;
    }
}

TEST(Unscented, EveryFormatIsNearDouble) {
    const GaussianCloud cloud = test::random_cloud(300, 5);
    for (const PublishedLens& lens : all_lenses()) {
        const Camera camera = turned_camera(lens);
        for (const auto& [format, unit] :
             {std::pair("fp32", std::ldexp(1.0, -24)), std::pair("e8m15", std::ldexp(1.0, -16))}) {
            int compared = 0;
            for (std::size_t i = 0; i < cloud.size(); ++i) {
                ProjectedSplat exact, rounded;
                if (project(cloud, i, camera, unscented(), exact) != Cull::None ||
                    exact.depth < 1 ||
                    project_anywhere(cloud, i, camera, unscented(format), rounded) != Cull::None) {
                    continue;
                }
                const double reach = std::sqrt(exact.cov_a + exact.cov_c);
                EXPECT_NEAR(rounded.mu_x, exact.mu_x, 2000 * 40 * unit) << lens.name;
                EXPECT_NEAR(rounded.mu_y, exact.mu_y, 2000 * 40 * unit) << lens.name;
                // Differences of two pixels, both off by some units of theirs.
                EXPECT_NEAR(rounded.cov_b, exact.cov_b, 8 * reach * 2000 * 40 * unit) << lens.name;
                ++compared;
            }
            EXPECT_GT(compared, 40) << lens.name << ' ' << format;
        }
    }
}

TEST(Unscented, MachineSinglesAreThoseOfTheRoundingProjector) {
    const GaussianCloud cloud = test::random_cloud(300, 9);
    for (const PublishedLens& lens : all_lenses()) {
        const Camera camera = turned_camera(lens);
        const auto machine = make_projector(cloud, camera, unscented("fp32"));
        const auto rounding = make_rounding_projector(cloud, camera, unscented("fp32"));
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            ProjectedSplat a, b;
            const Cull cull = machine->project_anywhere(i, a);
            ASSERT_EQ(cull, rounding->project_anywhere(i, b));
            if (cull == Cull::None) {
                EXPECT_EQ(a.mu_x, b.mu_x);
                EXPECT_EQ(a.cov_a, b.cov_a);
                EXPECT_EQ(a.cov_b, b.cov_b);
                EXPECT_EQ(a.det, b.det);
            }
        }
    }
}

// Whatever the sizes, splats are finite and positive definite, or culled.
TEST(Unscented, HugeSplatsAreLimited) {
    for (const PublishedLens& lens : all_lenses()) {
        const Camera camera = turned_camera(lens);
        for (const double near : {0.2, 0.0}) {
            for (const float scale : {0.5F, 10.0F, 1e6F, 1e15F}) {
                for (const glm::dvec3& seen :
                     {glm::dvec3(0.01, 0.02, 0.2001), glm::dvec3(3, 1, 2), glm::dvec3(0.1, 0, 5)}) {
                    GaussianCloud cloud;
                    add_gaussian(cloud, in_world(camera, seen), glm::vec3(scale), test::kNoTurn, 1,
                                 test::kGrey);
                    ProjectionOptions options = unscented();
                    options.near_plane = near;
                    ProjectedSplat splat;
                    const Cull cull = project_anywhere(cloud, 0, camera, options, splat);
                    if (cull == Cull::OffScreen) {
                        EXPECT_GT(glm::length(glm::dvec2(seen) / seen.z),
                                  camera.lens.slope_at(
                                      1.3 * glm::length(camera.raster_middle() /
                                                        glm::dvec2(camera.fx, camera.fy))));
                        continue;
                    }
                    ASSERT_EQ(cull, Cull::None) << lens.name << ' ' << scale;
                    EXPECT_TRUE(std::isfinite(splat.conic_a() + splat.conic_c()));
                    EXPECT_GT(splat.det, 0);
                    // No sigma point is beyond 1.3 times the corner.
                    const double corner =
                        1.3 * 0.5 * std::hypot(camera.width, camera.height * camera.fx / camera.fy);
                    EXPECT_LT(std::sqrt(splat.cov_a + splat.cov_c), 4 * corner) << lens.name;
                }
            }
        }
    }
}

// A lens shows nothing beyond the slope at which it folds back, although its polynomial would bend
// such directions into the image.
TEST(Unscented, MeansBeyondTheFoldAreCulled) {
    Camera camera = make_camera(64, 48, 20);
    camera.lens = PublishedLens{"", false, {-0.12}}.lens(); // 1.667
    for (const auto& [slope, cull] : {std::pair(1.6, Cull::None), std::pair(1.7, Cull::OffScreen),
                                      std::pair(2.8, Cull::OffScreen)}) {
        GaussianCloud cloud;
        add_gaussian(cloud, {4 * slope, 0, 4}, glm::vec3(0.01F), test::kNoTurn, 1, test::kGrey);
        ProjectedSplat splat;
        EXPECT_EQ(project_anywhere(cloud, 0, camera, unscented(), splat), cull) << slope;
        EXPECT_EQ(camera.landing_of(cloud.means[0]).has_value(), cull == Cull::None);
    }
    // 2.8 (1 - 0.12 * 7.84) lies in the image, on the wrong place of what is at 0.17.
    EXPECT_FALSE(camera.seen_depth({2.8 * 4, 0, 4}));
    EXPECT_TRUE(camera.seen_depth({0.17 * 4, 0, 4}));
}

TEST(Unscented, HostileLensesLeaveNothingOrSoundSplats) {
    const GaussianCloud cloud = test::random_cloud(100, 2);
    for (const double k : {1e300, -1e300, 1e30, -1e30, std::numeric_limits<double>::quiet_NaN()}) {
        for (const bool fisheye : {false, true}) {
            Camera camera = make_camera(64, 48, 50);
            camera.lens = PublishedLens{"", fisheye, {k, -k, 0, k}}.lens();
            const FrameWorkload frame =
                make_frame_workload(cloud, camera, 16, TileMode::Exact, unscented());
            EXPECT_EQ(frame.culled.total() + frame.splats.size(), cloud.size());
            for (const ProjectedSplat& splat : frame.splats) {
                EXPECT_TRUE(std::isfinite(splat.conic_a() + splat.conic_b() + splat.conic_c()));
            }
        }
    }
}

TEST(Unscented, RefusesWhatItCannotDrawInOneSentence) {
    const GaussianCloud cloud = test::random_cloud(1, 2);
    Camera camera = make_camera(64, 48, 50);
    camera.lens = published_lenses().back().lens();
    const auto complaint = [&](const ProjectionOptions& options) -> std::string {
        try {
            make_frame_workload(cloud, camera, 16, TileMode::Exact, options);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(complaint({}).find("pipeline.rules.projection: unscented"), std::string::npos);
    EXPECT_NE(complaint({}).find("pipeline.rules.lens: pinhole"), std::string::npos);
    ProjectionOptions negative = unscented();
    negative.sigma.alpha = 0.1;
    EXPECT_NE(complaint(negative).find("negative weight"), std::string::npos);
    ProjectionOptions pinhole;
    pinhole.lens = LensRule::Pinhole;
    EXPECT_EQ(complaint(pinhole), "");
}

// A pinhole in place of the lens is the pinhole's own frame.
TEST(Unscented, LensRuleLeavesDistortionOut) {
    const GaussianCloud cloud = test::random_cloud(200, 4);
    Camera bare = make_camera(64, 48, 50), bent = bare;
    bent.lens = published_lenses()[2].lens();
    for (const ProjectionRule rule : {ProjectionRule::Linear, ProjectionRule::Unscented}) {
        ProjectionOptions options;
        options.rule = rule;
        options.lens = LensRule::Pinhole;
        const FrameWorkload a = make_frame_workload(cloud, bare, 16, TileMode::Exact, options);
        const FrameWorkload b = make_frame_workload(cloud, bent, 16, TileMode::Exact, options);
        ASSERT_EQ(a.splats.size(), b.splats.size());
        for (std::size_t i = 0; i < a.splats.size(); ++i) {
            EXPECT_EQ(a.splats[i].mu_x, b.splats[i].mu_x);
            EXPECT_EQ(a.splats[i].det, b.splats[i].det);
        }
    }
}

// The lens bends slopes, so that it is the same at every size and in every part of the image.
TEST(UnscentedLens, CropsAndSizesKeepTheLens) {
    const GaussianCloud cloud = test::random_cloud(200, 6);
    for (const PublishedLens& lens : all_lenses()) {
        const Camera camera = turned_camera(lens);
        const Camera half = camera.scaled_to_width(640);
        const Camera crop = camera.cropped({200, 100, 700, 500});
        EXPECT_EQ(half.lens, camera.lens);
        EXPECT_EQ(crop.lens, camera.lens);
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            ProjectedSplat whole, small, part;
            ProjectionOptions bare = unscented();
            bare.dilation = 0;
            const Cull cull = project_anywhere(cloud, i, camera, bare, whole);
            ASSERT_EQ(project_anywhere(cloud, i, half, bare, small), cull);
            ASSERT_EQ(project_anywhere(cloud, i, crop, bare, part), cull);
            if (cull == Cull::None) {
                EXPECT_NEAR(0.5 * (whole.mu_x + 0.5), small.mu_x + 0.5, 1e-9);
                EXPECT_NEAR(0.25 * whole.cov_a, small.cov_a, 1e-9 * whole.cov_a);
                EXPECT_EQ(part.mu_x, whole.mu_x); // in the raster
                EXPECT_EQ(part.det, whole.det);
            }
        }
    }
}

} // namespace
} // namespace degs
