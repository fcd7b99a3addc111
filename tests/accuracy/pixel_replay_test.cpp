// SPDX-License-Identifier: Apache-2.0
// Replays of single pixels against whole images, and the blame for errors that were put there.
#include <cmath>

#include "accuracy/data_path_renderer.hpp"
#include "accuracy/pixel_replay.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

FrameWorkload replayed_view() {
    return make_frame_workload(test::random_cloud(4000, 11), test::make_camera(60, 50, 50), 16,
                               TileMode::Exact);
}

/// Largest distance of replays from an image, over some of its pixels.
template <class Replay>
double distance(const Image& image, const Replay& replay) {
    double most = 0;
    for (int y = 0; y < image.height; y += 5) {
        for (int x = 0; x < image.width; x += 3) {
            const PixelReplay pixel = replay(x, y);
            const std::size_t at = image.at(x, y);
            for (std::size_t c = 0; c < 3; ++c) {
                most = std::max(most, std::abs(pixel.rgb[c] - image.rgb[3 * at + c]));
            }
            most = std::max(most, std::abs(pixel.transmittance - image.transmittance[at]));
        }
    }
    return most;
}

TEST(PixelReplay, ReferenceIsTheReference) {
    const FrameWorkload work = replayed_view();
    ReferenceCounts counts;
    const Image image = render_reference(work, counts);
    ASSERT_GT(counts.terminated, 0U); // ends are replayed, too
    EXPECT_LT(distance(image, [&](int x, int y) { return replay_reference(work, x, y); }), 1e-6);
}

TEST(PixelReplay, RowPathIsTheDataPath) {
    const FrameWorkload work = replayed_view();
    for (const char* name : {"ideal", "paper", "tuned"}) {
        DataPathRender options;
        options.numbers = named_numbers(name);
        const Image image = DataPathRenderer(work, options).render(all_tiles(work));
        const QuantizedRow row(number_set(name));
        // Lanes round products of the PE twice: a unit of a format here and there.
        const double most = name == std::string("paper") ? 1e-3 : 1e-4;
        EXPECT_LT(
            distance(image,
                     [&](int x, int y) { return replay_row(work, x, y, row, StopRule::Refuse); }),
            most)
            << name;
    }
}

/// One pixel of two splats, the far one four times as bright.
FrameWorkload two_splats() {
    GaussianCloud cloud;
    const glm::vec4 upright(1, 0, 0, 0);
    test::add_gaussian(cloud, {0.03, 0.01, 2}, {0.2F, 0.2F, 0.2F}, upright, 0.3F,
                       {0.1F, 0.1F, 0.1F});
    test::add_gaussian(cloud, {-0.02, 0.013, 3}, {0.4F, 0.3F, 0.3F}, upright, 0.8F,
                       {0.4F, 0.3F, 0.4F});
    return make_frame_workload(cloud, test::make_camera(32, 32, 40), 32, TileMode::Exact);
}

struct Fault {
    const char* operation;
    void (*put)(NumberSet& set);
};

TEST(PixelReplay, NamesTheOperationThatIsCoarse) {
    const FrameWorkload work = two_splats();
    const Fault faults[] = {
        {"mean", [](NumberSet& set) { set.mean = parse_format("q10.0"); }},
        {"A", [](NumberSet& set) { set.conic = parse_format("e6m2"); }},
        {"colour", [](NumberSet& set) { set.colour = parse_format("e5m2"); }},
        {"q", [](NumberSet& set) { set.q = parse_format("q6.1"); }},
        {"alpha", [](NumberSet& set) { set.alpha = parse_format("uq0.3"); }},
        {"sum", [](NumberSet& set) { set.sum = parse_format("q4.3"); }},
        {"transmittance", [](NumberSet& set) { set.transmittance = parse_format("uq1.3"); }},
        {"exp", [](NumberSet& set) { set.exp.values = parse_format("uq1.3"); }},
    };
    for (const Fault& fault : faults) {
        NumberSet set = number_set("ideal");
        fault.put(set);
        const PixelBlame blame = blame_pixel(work, 13, 18, set, StopRule::Refuse);
        EXPECT_EQ(blame.operation, fault.operation);
        EXPECT_DOUBLE_EQ(blame.explained, blame.error) << fault.operation;
        EXPECT_GT(blame.error, 1e-3) << fault.operation;
        EXPECT_EQ(blame.flip, "") << fault.operation;
    }
}

TEST(PixelReplay, NamesTheGaussian) {
    const FrameWorkload work = two_splats();
    NumberSet set = number_set("ideal");
    set.alpha = parse_format("uq0.3");
    const PixelBlame blame = blame_pixel(work, 13, 18, set, StopRule::Refuse);
    const PixelReplay exact = replay_reference(work, 13, 18);
    const PixelReplay coarse = replay_row(work, 13, 18, QuantizedRow(set), StopRule::Refuse);
    // By hand: C = a1 c1 + (1 - a1) a2 c2 with one of the alphas exchanged.
    const double c1 = work.splats[0].colour[0];
    const double c2 = work.splats[1].colour[0];
    const double first = std::abs((coarse.alpha[0] - exact.alpha[0]) * (c1 - exact.alpha[1] * c2));
    const double second = std::abs((coarse.alpha[1] - exact.alpha[1]) * (1 - exact.alpha[0]) * c2);
    ASSERT_NE(first, second);
    EXPECT_EQ(blame.id, work.splats[first > second ? 0 : 1].id);
}

// A pixel right of the ellipse: only outward ends draw it.
TEST(PixelReplay, NamesFlips) {
    const FrameWorkload work = two_splats();
    NumberSet set = number_set("ideal");
    set.ends = SpanEnds::Outward;
    int found = 0;
    for (int x = 16; x < 32; ++x) {
        const PixelBlame blame = blame_pixel(work, x, 16, set, StopRule::Refuse);
        if (blame.error > 1e-6) {
            ++found;
            EXPECT_EQ(blame.operation, "span ends");
            EXPECT_EQ(blame.flip, "span ends");
        }
    }
    EXPECT_EQ(found, 1); // the far splat fills the row
}

TEST(PixelReplay, NothingToBlame) {
    const FrameWorkload work = two_splats();
    const PixelBlame blame = blame_pixel(work, 13, 18, number_set("ideal"), StopRule::Refuse);
    EXPECT_LT(blame.error, 1e-14);
}

/// Two splats of nearly one depth, the far one first in the cloud.
FrameWorkload near_pair(const std::string& format) {
    GaussianCloud cloud;
    const glm::vec4 upright(1, 0, 0, 0);
    test::add_gaussian(cloud, {0.03, 0.01, 3.001}, {0.3F, 0.3F, 0.3F}, upright, 0.6F,
                       {0.1F, 0.1F, 0.9F});
    test::add_gaussian(cloud, {0.03, 0.01, 3}, {0.3F, 0.3F, 0.3F}, upright, 0.6F,
                       {0.9F, 0.1F, 0.1F});
    ProjectionOptions options;
    options.numbers.format = parse_format(format);
    return make_frame_workload(cloud, test::make_camera(32, 32, 40), 32, TileMode::Exact, options);
}

TEST(PixelReplay, NamesTheProjection) {
    const FrameWorkload exact = near_pair("fp64");
    NumberSet set = number_set("ideal");
    const auto blame = [&](const std::string& format, int x) {
        return blame_pixel(exact, near_pair(format), x, 16, set, StopRule::Refuse);
    };
    const PixelBlame apart = blame("fp16", 16); // a unit of 1/512: the depths stay apart
    EXPECT_EQ(apart.operation, "projection");
    EXPECT_EQ(apart.flip, "");
    EXPECT_LT(apart.error, 1e-2);
    const PixelBlame order = blame("e5m9", 16); // 1/256: one depth
    EXPECT_EQ(order.operation, "projection");
    EXPECT_EQ(order.flip, "depth order");
    EXPECT_GT(order.error, 0.1);
    EXPECT_NEAR(order.explained, order.error, 1e-12);
    set.sum = parse_format("uq4.2");
    EXPECT_EQ(blame("fp16", 16).operation, "sum"); // the larger of the two
    EXPECT_EQ(blame("fp32", 16).operation, "sum");
}

} // namespace
} // namespace degs
