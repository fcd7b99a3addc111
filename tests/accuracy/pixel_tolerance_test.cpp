// SPDX-License-Identifier: Apache-2.0
// The bound on a pixel's error holds, is not a blank cheque, and spans differ where it says so.
#include <cmath>

#include "accuracy/data_path_renderer.hpp"
#include "accuracy/pixel_tolerance.hpp"
#include "accuracy/span_difference.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/modules/degs/workload_fixture.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

FrameWorkload bounded_view(unsigned seed) {
    return make_frame_workload(test::random_cloud(250, seed), test::make_camera(90, 70, 70), 32,
                               TileMode::Exact);
}

/// Pixels of an image in the numbers `drawn` beyond the bound for `claimed`, of those with an
/// error.
int beyond(const FrameWorkload& work, const char* drawn, const char* claimed, double& largest) {
    DataPathRender options;
    options.numbers = named_numbers(drawn);
    ReferenceCounts counts;
    const Image image = DataPathRenderer(work, options).render(all_tiles(work));
    const Image reference = render_reference(work, counts);
    const NumberTolerance numbers = tolerance_of(number_set(claimed), work);
    int count = 0;
    largest = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const double bound = pixel_tolerance(work, x, y, numbers) + 2e-7; // floats
            largest = std::max(largest, bound);
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t at = 3 * image.at(x, y) + c;
                count += std::abs(double{image.rgb[at]} - reference.rgb[at]) > bound ? 1 : 0;
            }
        }
    }
    return count;
}

TEST(PixelTolerance, HoldsForEverySetThatHasOne) {
    for (const unsigned seed : {1U, 2U, 3U}) {
        const FrameWorkload work = bounded_view(seed);
        for (const char* name : {"ideal", "fp32", "paper", "tuned"}) {
            double largest = 0;
            EXPECT_EQ(beyond(work, name, name, largest), 0) << name << ", seed " << seed;
        }
    }
}

TEST(PixelTolerance, IsBrokenByCoarserNumbers) {
    const FrameWorkload work = bounded_view(4);
    double largest = 0;
    EXPECT_GT(beyond(work, "tuned", "fp32", largest), 100);
    EXPECT_GT(beyond(work, "paper", "fp32", largest), 10);
    EXPECT_GT(beyond(work, "fp32", "ideal", largest), 10);
}

TEST(SpanDifference, EqualNumbersHaveEqualSpans) {
    const FrameWorkload work = bounded_view(5);
    const SpanDifference same = compare_spans(work, named_numbers("fp32"), named_numbers("fp32"));
    EXPECT_GT(same.spans, 1000U);
    EXPECT_GT(same.pixels, same.spans);
    EXPECT_EQ(same.flips, 0U);
    EXPECT_TRUE(same.inside);
}

// Outward ends add a pixel at each end that is not a pixel's centre, unless the image ends there.
TEST(SpanDifference, CountsEveryPixelOnce) {
    FrameWorkload work;
    work.camera = test::make_camera(64, 48, 50);
    work.tile_size = 16;
    GaussianCloud cloud;
    test::add_gaussian(cloud, {0.013, 0.017, 2}, {0.1F, 0.1F, 0.1F}, {1, 0, 0, 0}, 0.7F,
                       {0.5F, 0.5F, 0.5F});
    work = make_frame_workload(cloud, work.camera, 16, TileMode::Exact);
    DataPathOptions outward = named_numbers("fp64");
    outward.ends = SpanEnds::Outward;
    const SpanDifference wider = compare_spans(work, outward, named_numbers("fp64"));
    EXPECT_EQ(wider.flips, 2 * wider.spans);
    EXPECT_GT(wider.farthest, 0.01);
    const SpanDifference narrower = compare_spans(work, named_numbers("fp64"), outward);
    EXPECT_EQ(narrower.flips, wider.flips);
    EXPECT_EQ(narrower.pixels + narrower.flips, wider.pixels);
}

// Errors of alpha and of the update for every splat, weighted with what the splats before it leave;
// behind the third splat of alpha 0.98 a pixel may end here or a little later, with what is left.
TEST(PixelTolerance, AddsUpAlongAPixel) {
    const NumberTolerance numbers{1e-3, 1e-5, false};
    const auto bound = [&](const std::vector<double>& opacities) {
        std::vector<ProjectedSplat> splats;
        for (const double opacity : opacities) {
            splats.push_back(test::make_splat(8, 8, 1e4, 1e4, 0, opacity));
            splats.back().colour[1] = 2;
        }
        return pixel_tolerance(test::make_frame(splats, 16, 16, 16), 8, 8, numbers);
    };
    EXPECT_NEAR(bound({0.5}), 2 * (1e-3 + 1e-5), 1e-12);
    EXPECT_NEAR(bound({0.5, 0.25}), 2 * (1.5e-3 + 2e-5), 1e-12);
    EXPECT_NEAR(bound({0.98, 0.98, 0.98, 0.98}), 2 * (1.0204e-3 + 3e-5 + 4e-4), 1e-12);
}

} // namespace
} // namespace degs
