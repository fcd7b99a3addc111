// SPDX-License-Identifier: Apache-2.0
// Order of splats and compensated opacities against formulas in long double.
#include "splat/frame/rendering_rules.hpp"

#include <algorithm>

#include "accuracy/data_path_renderer.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

using test::add_gaussian;
using test::brute_project;
using test::make_camera;

/// A camera that is turned and away from the origin, with a wide view.
Camera wide_camera() {
    Camera camera = make_camera(90, 70, 45);
    camera.position = {0.3, -0.2, -0.5};
    camera.camera_to_world =
        glm::dmat3(test::rotation_matrix(glm::normalize(glm::vec4(1, 0.1F, -0.2F, 0.3F))));
    return camera;
}

ProjectionOptions with(SplatOrder order, bool compensated, double low_pass = 0.3) {
    ProjectionOptions options;
    options.order = order;
    options.compensated = compensated;
    options.dilation = low_pass;
    return options;
}

TEST(RenderingRules, DistanceIsTheLengthOfTheOffset) {
    const GaussianCloud cloud = test::random_cloud(400, 3);
    const Camera camera = wide_camera();
    const ProjectionOptions options = with(SplatOrder::Distance, false);
    const FrameWorkload frame = make_frame_workload(cloud, camera, 16, TileMode::Exact, options);
    const FrameWorkload plain = make_frame_workload(cloud, camera, 16, TileMode::Exact);
    ASSERT_GT(frame.splats.size(), 200U);
    ASSERT_EQ(frame.visible_of, plain.visible_of); // the order decides nothing else
    std::size_t moved = 0;
    for (std::size_t i = 0; i < frame.splats.size(); ++i) {
        const ProjectedSplat& splat = frame.splats[i];
        const long double length =
            glm::length(test::Vector(cloud.means[splat.id]) - test::Vector(camera.position));
        EXPECT_NEAR(splat.depth / static_cast<double>(length), 1, 1e-15);
        moved += splat.id != plain.splats[i].id ? 1 : 0;
    }
    EXPECT_TRUE(std::is_sorted(frame.splats.begin(), frame.splats.end(),
                               [](const auto& a, const auto& b) { return a.depth < b.depth; }));
    EXPECT_GT(moved, 100U);
}

// What makes the distance attractive: a camera that turns in place sees the same order.
TEST(RenderingRules, OrderByDistanceDoesNotTurnWithTheCamera) {
    const GaussianCloud cloud = test::random_cloud(400, 4);
    const auto rank = [&cloud](SplatOrder order, double angle) {
        Camera camera = make_camera(90, 70, 45);
        const glm::dvec3 right(std::cos(angle), 0, -std::sin(angle));
        const glm::dvec3 forward(std::sin(angle), 0, std::cos(angle));
        camera.camera_to_world = glm::dmat3(right, glm::dvec3(0, 1, 0), forward);
        std::vector<std::uint32_t> places(cloud.size(), 0);
        std::uint32_t place = 0;
        for (const ProjectedSplat& splat :
             make_frame_workload(cloud, camera, 16, TileMode::Exact, with(order, false)).splats) {
            places[splat.id] = ++place;
        }
        return places;
    };
    const auto inversions = [&](SplatOrder order) {
        const std::vector<std::uint32_t> a = rank(order, 0), b = rank(order, 0.3);
        int count = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const bool seen = a[i] != 0 && a[j] != 0 && b[i] != 0 && b[j] != 0;
                count += seen && (a[i] < a[j]) != (b[i] < b[j]) ? 1 : 0;
            }
        }
        return count;
    };
    EXPECT_EQ(inversions(SplatOrder::Distance), 0);
    EXPECT_GT(inversions(SplatOrder::Depth), 100);
}

TEST(RenderingRules, CompensationIsTheRootOfTheRatioOfDeterminants) {
    GaussianCloud cloud = test::random_cloud(400, 5);
    for (glm::vec3& scale : cloud.scales) {
        scale *= 0.3F; // about a pixel
    }
    const Camera camera = wide_camera();
    for (const double low_pass : {0.3, 0.1}) {
        const ProjectionOptions options = with(SplatOrder::Depth, true, low_pass);
        int compared = 0, faded = 0;
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            const test::BruteSplat brute = brute_project(cloud, i, camera, options);
            ProjectedSplat splat;
            const Cull cull = project_anywhere(cloud, i, camera, options, splat);
            const auto opacity = static_cast<double>(brute.opacity);
            if (cull == Cull::None) {
                EXPECT_NEAR(splat.opacity / opacity, 1, 1e-12);
                EXPECT_NEAR(splat.q_threshold, 2 * std::log(255 * opacity), 1e-12);
                EXPECT_LT(splat.opacity, cloud.opacities[i]);
                ++compared;
            } else if (cull == Cull::Transparent) {
                EXPECT_LT(opacity, 1.0 / 255 * (1 + 1e-12));
                faded += cloud.opacities[i] > 1.0F / 255 ? 1 : 0;
            }
        }
        EXPECT_GT(compared, 200);
        EXPECT_GT(faded, 0);
    }
}

// A line has no area: the ratio is 0, and the floor of the original code decides.
TEST(RenderingRules, CompensationHasAFloor) {
    GaussianCloud cloud;
    add_gaussian(cloud, {0, 0, 5}, glm::vec3(0.2F, 0, 0), test::kNoTurn, 1.0F, test::kGrey);
    ProjectedSplat splat;
    ASSERT_EQ(project(cloud, 0, make_camera(65, 65, 100), with(SplatOrder::Depth, true), splat),
              Cull::None);
    EXPECT_NEAR(splat.opacity, 0.005, 1e-15);
    cloud.opacities[0] = 0.78F; // 0.0039 is below 1/255
    EXPECT_EQ(project(cloud, 0, make_camera(65, 65, 100), with(SplatOrder::Depth, true), splat),
              Cull::Transparent);
}

/// The ellipse ends at the cut or where alpha is 1/255, whichever is nearer; the opacity stays.
TEST(RenderingRules, ACutEndsWhatReachesFurther) {
    const GaussianCloud cloud = test::random_cloud(400, 7);
    const Camera camera = wide_camera();
    for (const char* const format : {"fp64", "fp32", "fp16"}) {
        ProjectionOptions plain, cut;
        plain.numbers.format = cut.numbers.format = parse_format(format);
        cut.cut = 9;
        int nearer = 0, same = 0;
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            ProjectedSplat whole, ended;
            if (project_anywhere(cloud, i, camera, plain, whole) != Cull::None) {
                continue;
            }
            ASSERT_EQ(project_anywhere(cloud, i, camera, cut, ended), Cull::None);
            EXPECT_EQ(whole.q_cut_off, 0);
            EXPECT_EQ(ended.q_threshold, std::min(whole.q_threshold, 9.0));
            EXPECT_DOUBLE_EQ(ended.q_threshold + ended.q_cut_off, whole.q_threshold);
            EXPECT_EQ(ended.opacity, whole.opacity);
            EXPECT_EQ(ended.cov_a, whole.cov_a);
            ++(ended.q_cut_off > 0 ? nearer : same);
        }
        EXPECT_GT(nearer, 50);
        EXPECT_GT(same, 50);
    }
}

/// Values of a format are within a few of its units of double; p bits of significand.
void expect_follows(const std::string& format, int p) {
    const GaussianCloud cloud = test::random_cloud(300, 6);
    const Camera camera = wide_camera();
    ProjectionOptions options = with(SplatOrder::Distance, true);
    const double unit = std::ldexp(1.0, -p);
    int compared = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        ProjectedSplat exact, rounded;
        options.numbers.format = NumberFormat();
        const Cull wanted = project_anywhere(cloud, i, camera, options, exact);
        options.numbers.format = parse_format(format);
        if (wanted != Cull::None ||
            project_anywhere(cloud, i, camera, options, rounded) != Cull::None ||
            exact.depth > 3 * brute_project(cloud, i, camera).depth) {
            continue;
        }
        EXPECT_NEAR(rounded.depth / exact.depth, 1, 100 * unit);
        EXPECT_NEAR(std::log(rounded.opacity / exact.opacity), 0, 400 * unit) << i;
        ++compared;
    }
    EXPECT_GT(compared, 200);
}

TEST(RenderingRules, HoldInEveryFormatOfTheProjection) {
    expect_follows("fp32", 24);
    expect_follows("fp16", 11);
    expect_follows("e8m17", 18);
}

TEST(RenderingRules, ReferenceImagesFollowThem) {
    const GaussianCloud cloud = test::random_cloud(250, 8, 1);
    const Camera camera = wide_camera();
    std::vector<float> plain;
    for (const SplatOrder order : {SplatOrder::Depth, SplatOrder::Distance}) {
        for (const bool compensated : {false, true}) {
            for (const double low_pass : {0.3, 0.1}) {
                const ProjectionOptions options = with(order, compensated, low_pass);
                ReferenceCounts counts;
                const Image image = render_reference(
                    make_frame_workload(cloud, camera, 16, TileMode::Exact, options), counts);
                test::expect_same_image(image, test::brute_render(cloud, camera, options));
                plain = plain.empty() ? image.rgb : plain;
                const bool changed = order != SplatOrder::Depth || compensated || low_pass != 0.3;
                EXPECT_EQ(image.rgb != plain, changed);
            }
        }
    }
}

/// The reference's pixels and those of data paths in double, which solve rows or test every pixel.
TEST(RenderingRules, CutsReachEveryImage) {
    const GaussianCloud cloud = test::random_cloud(250, 9, 1);
    const Camera camera = wide_camera();
    std::vector<float> plain;
    for (const double cut : {kNoCut, 9.0, 4.0, 0.5}) {
        ProjectionOptions options = with(SplatOrder::Distance, false);
        options.cut = cut;
        const FrameWorkload frame =
            make_frame_workload(cloud, camera, 16, TileMode::Exact, options);
        ReferenceCounts counts;
        const Image image = render_reference(frame, counts);
        test::expect_same_image(image, test::brute_render(cloud, camera, options));
        plain = plain.empty() ? image.rgb : plain;
        EXPECT_EQ(image.rgb != plain, cut != kNoCut);
        for (const bool parsing : {true, false}) {
            DataPathRender path;
            path.numbers.numbers = Arithmetic::Fp64;
            path.parsing = parsing;
            DataPathRenderer renderer(frame, path);
            EXPECT_EQ(renderer.render(all_tiles(frame)).fragments, image.fragments);
            EXPECT_EQ(renderer.counts().useful, counts.fragments);
            EXPECT_EQ(renderer.counts().boundary > 0, !parsing);
        }
    }
}

TEST(RenderingRules, PresetsAreSetsOfRules) {
    const RenderingRules inria, khr(RuleSet::Khr);
    EXPECT_EQ(inria.options(false).cut, ProjectionOptions().cut);
    EXPECT_EQ(inria.options(false).order, SplatOrder::Depth);
    EXPECT_EQ(khr.options(false).cut, 9);
    EXPECT_EQ(khr.options(false).order, SplatOrder::Distance);
    EXPECT_EQ(khr.options(false).dilation, ProjectionOptions().dilation);
    EXPECT_FALSE(khr.options(false).compensated);
    EXPECT_TRUE(khr.options(true).compensated);
    EXPECT_EQ(RenderingRules(RuleSet::Inria).cut, inria.cut);
}

TEST(RenderingRules, AFileDecidesWhereTheRulesLeaveItToTheScene) {
    RenderingRules rules;
    EXPECT_FALSE(rules.options(false).compensated);
    EXPECT_TRUE(rules.options(true).compensated);
    rules.antialiasing = Antialiasing::Off;
    EXPECT_FALSE(rules.options(true).compensated);
    rules.antialiasing = Antialiasing::On;
    EXPECT_TRUE(rules.options(false).compensated);
    rules.order = SplatOrder::Distance;
    rules.low_pass = 0.1;
    ProjectionNumbers numbers;
    numbers.format = parse_format("fp16");
    const ProjectionOptions options = rules.options(false, numbers);
    EXPECT_EQ(options.order, SplatOrder::Distance);
    EXPECT_EQ(options.dilation, 0.1);
    EXPECT_EQ(options.numbers.format, parse_format("fp16"));
    EXPECT_EQ(RenderingRules().options(false).dilation, ProjectionOptions().dilation);
}

} // namespace
} // namespace degs
