// SPDX-License-Identifier: Apache-2.0
// A cut includes its limit: no design loses a pixel centre that lies exactly on the ellipse.
#include <cmath>
#include <deque>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "accuracy/data_path_renderer.hpp"
#include "degs/design.hpp"
#include "splat/frame/subtile_cover.hpp"
#include "tests/baselines/engine_run.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

using test::EngineRun;

constexpr double kOpacities[] = {0.05, 0.1, 0.15, 0.2,  0.25, 0.36, 0.45,
                                 0.5,  0.6, 0.75, 0.85, 0.9,  0.99};
constexpr int kPerRow = 4, kApart = 64, kSide = kPerRow * kApart + 1;

/// Standard deviations in px along the axes.
struct Ellipse {
    int x, y;
};
/// 3-4-5 triangles put pixels of the last two on their edges beside the axes.
constexpr Ellipse kEllipses[] = {{1, 1}, {2, 2}, {3, 2}, {1, 4}, {5, 5}, {5, 10}};

/// Discs across the view whose means are pixel centres, one of each opacity, apart from each other.
struct EdgeScene {
    GaussianCloud cloud;
    Camera camera = test::make_camera(kSide, kSide, 64);
    Ellipse ellipse;

    explicit EdgeScene(const Ellipse& shape) : ellipse(shape) {
        for (std::size_t i = 0; i < std::size(kOpacities); ++i) {
            const glm::dvec3 mean((centre_x(i) - kSide / 2) / 16.0,
                                  (centre_y(i) - kSide / 2) / 16.0, 4);
            test::add_gaussian(
                cloud, mean,
                {static_cast<float>(ellipse.x) / 16, static_cast<float>(ellipse.y) / 16, 0},
                test::kNoTurn, static_cast<float>(kOpacities[i]), test::kGrey);
        }
    }
    static int centre_x(std::size_t i) {
        return static_cast<int>(i) % kPerRow * kApart + kApart / 2 + 1;
    }
    static int centre_y(std::size_t i) {
        return static_cast<int>(i) / kPerRow * kApart + kApart / 2 + 2;
    }

    FrameWorkload frame(double cut, int tile_size) const {
        ProjectionOptions options;
        options.dilation = 0;
        options.cut = cut;
        return make_frame_workload(cloud, camera, tile_size, TileMode::Exact, options);
    }
    /// Splats per pixel, in integers but for where alpha is 1/255.
    std::vector<std::uint32_t> fragments(int cut) const {
        std::vector<std::uint32_t> counts(std::size_t{kSide} * kSide, 0);
        const int xx = ellipse.x * ellipse.x, yy = ellipse.y * ellipse.y;
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                for (std::size_t i = 0; i < std::size(kOpacities); ++i) {
                    const int dx = x - centre_x(i), dy = y - centre_y(i);
                    const int scaled = dx * dx * yy + dy * dy * xx; // q xx yy
                    const double q = static_cast<double>(scaled) / (xx * yy);
                    const double most = 2 * std::log(255.0 * cloud.opacities[i]);
                    counts[y * kSide + x] += scaled <= cut * xx * yy && q <= most ? 1 : 0;
                }
            }
        }
        return counts;
    }
};

void expect_near(const Image& image, const Image& reference) {
    double most = 0;
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        most = std::max<double>(most, std::abs(image.rgb[i] - reference.rgb[i]));
    }
    EXPECT_LT(most, 1e-3); // single precision of coefficients that are multiplied out
}

class SmallRunCutEdge : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(SmallRunCutEdge, IsPartOfEverySplat) {
    const auto& [file, numbers] = GetParam();
    std::vector<std::string> changes = {std::string("pipeline.numbers=") + numbers};
    if (std::string(file) == "degs-16") {
        changes.emplace_back(
            "pipeline.span_ends=exact"); // outward ends draw a pixel beyond on purpose
    }
    const Design design = load_design(std::string(DEGS_CONFIGS) + "/" + file + ".yaml", changes);
    const int tile_size = design.accelerator().tile_size_px();
    struct Case {
        int cut;
        EdgeScene scene;
        FrameWorkload frame;
        std::unique_ptr<EngineRun> run;
    };
    std::deque<Case> cases;
    for (const int cut : {1, 4, 9}) {
        for (const Ellipse& ellipse : kEllipses) {
            EdgeScene scene(ellipse);
            FrameWorkload frame = scene.frame(cut, tile_size);
            ASSERT_EQ(frame.splats.size(), std::size(kOpacities));
            Case& each = cases.emplace_back(Case{cut, std::move(scene), std::move(frame), nullptr});
            const std::string name = "run_" + std::to_string(cases.size());
            each.run = std::make_unique<EngineRun>(name, design.accelerator(),
                                                   std::vector<const FrameWorkload*>{&each.frame});
        }
    }
    sc_core::sc_start();
    for (const Case& each : cases) {
        SCOPED_TRACE(testing::Message() << "cut " << each.cut << ", " << each.scene.ellipse.x
                                        << " x " << each.scene.ellipse.y << " px");
        EXPECT_EQ(each.run->image().fragments, each.scene.fragments(each.cut));
        ReferenceCounts counts;
        expect_near(each.run->image(), render_reference(each.frame, counts));
    }
}

INSTANTIATE_TEST_SUITE_P(Designs, SmallRunCutEdge,
                         ::testing::Combine(::testing::Values("degs-16", "gscore-16", "gbu-16",
                                                              "gcc-16", "orange-o1"),
                                            ::testing::Values("fp64", "fp32")),
                         [](const auto& row) {
                             std::string name =
                                 std::string(std::get<0>(row.param)) + "_" + std::get<1>(row.param);
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(CutEdge, IsPartOfTheReferenceAndOfEveryDataPath) {
    for (const int cut : {1, 4, 9}) {
        for (const Ellipse& ellipse : kEllipses) {
            SCOPED_TRACE(testing::Message()
                         << "cut " << cut << ", " << ellipse.x << " x " << ellipse.y);
            const EdgeScene scene(ellipse);
            for (const int tile_size : {4, 16, 30}) {
                const FrameWorkload frame = scene.frame(cut, tile_size);
                ReferenceCounts counts;
                EXPECT_EQ(render_reference(frame, counts).fragments, scene.fragments(cut));
                for (const Arithmetic numbers : {Arithmetic::Fp32, Arithmetic::Fp64}) {
                    for (const bool parsing : {true, false}) {
                        DataPathRender path;
                        path.numbers.numbers = numbers;
                        path.parsing = parsing;
                        DataPathRenderer renderer(frame, path);
                        EXPECT_EQ(renderer.render(all_tiles(frame)).fragments,
                                  scene.fragments(cut));
                    }
                }
            }
        }
    }
}

/// Tiles and sub-tiles of one pixel: each pixel on the edge is named by itself.
TEST(CutEdge, IsPartOfWhatBoundsASplat) {
    for (const int cut : {1, 4, 9}) {
        for (const Ellipse& ellipse : kEllipses) {
            const EdgeScene scene(ellipse);
            const FrameWorkload frame = scene.frame(cut, 1);
            for (const ProjectedSplat& splat : frame.splats) {
                const OrientedBox box(splat);
                const PixelBox bounds = pixel_box(splat, {0, 0, kSide - 1, kSide - 1});
                const int x = static_cast<int>(splat.mu_x), y = static_cast<int>(splat.mu_y);
                if (splat.q_cut_off == 0) { // alpha is 1/255 before the cut
                    continue;
                }
                const int n = static_cast<int>(std::sqrt(cut));
                const int right = x + n * ellipse.x, bottom = y + n * ellipse.y;
                EXPECT_EQ(bounds.x1, right);
                EXPECT_EQ(bounds.y1, bottom);
                EXPECT_TRUE(box.meets(right, y, 1) && box.meets(x, bottom, 1));
                std::vector<TileRun> runs;
                cover_tiles(splat, TileGrid{kSide, kSide, 1}, TileMode::Exact, runs);
                ASSERT_EQ(runs.size(), 2U * n * ellipse.y + 1);
                EXPECT_EQ(runs.back().first, x);
                EXPECT_EQ(runs[n * ellipse.y].last, right);
            }
        }
    }
}

} // namespace
} // namespace degs
