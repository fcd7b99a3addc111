// SPDX-License-Identifier: Apache-2.0
// SH coefficients and depth keys in formats of their own.
#include "splat/numbers/projection_numbers.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "splat/numbers/stored_sh.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

ProjectionNumbers stored_in(const char* dc, const char* rest, const char* key) {
    ProjectionNumbers numbers;
    numbers.sh_dc = parse_format(dc);
    numbers.sh_rest = parse_format(rest);
    numbers.depth_key = parse_format(key);
    return numbers;
}

FrameWorkload frame_in(const GaussianCloud& cloud, const ProjectionNumbers& numbers) {
    ProjectionOptions options;
    options.numbers = numbers;
    return make_frame_workload(cloud, test::make_camera(90, 50, 60), 16, TileMode::Exact, options);
}

TEST(ProjectionNumbers, HaveDifferentNames) {
    std::set<std::string> names;
    std::size_t made = 0;
    for (const char* dc : {"fp64", "q3.5"}) {
        for (const char* rest : {"fp64", "q1.7"}) {
            for (const char* key : {"fp32", "ue4m12b3"}) {
                const ProjectionNumbers numbers = stored_in(dc, rest, key);
                EXPECT_EQ(numbers.is_reference(), numbers.name() == "fp64");
                names.insert(numbers.name());
                ++made;
            }
        }
    }
    EXPECT_EQ(names.size(), made);
    EXPECT_EQ(stored_in("q3.5", "q1.7", "ue4m12b3").name(),
              "fp64, SH q3.5 and q1.7, depth keys ue4m12b3");
}

TEST(StoredShCoefficients, AreRoundedByDegree) {
    const StoredSh stored(stored_in("q3.5", "q1.7", "fp32"));
    const float given[12] = {5, 0.51F, -0.1F, 0.004F, 0.0038F, -3, 2, 0.5F, 0, 1e-9F, -0.3F, 0.1F};
    StoredSh::Values room{};
    const float* const read = stored.read(given, 1, room);
    EXPECT_EQ(read[0], 127.0F / 32); // saturates
    EXPECT_EQ(read[1], 0.5F);
    EXPECT_EQ(read[2], -3.0F / 32);
    EXPECT_EQ(read[3], 1.0F / 128); // 0.512 units
    EXPECT_EQ(read[4], 0.0F);       // 0.486 units
    EXPECT_EQ(read[5], -127.0F / 128);
    EXPECT_EQ(read[6], 127.0F / 128);
    const StoredSh untouched{ProjectionNumbers()};
    EXPECT_EQ(untouched.read(given, 1, room), given);
}

// The colours are those of a scene whose file holds the rounded coefficients, and nothing else
// changes.
TEST(StoredShCoefficients, MakeTheColoursOfARoundedScene) {
    const GaussianCloud cloud = test::random_cloud(800, 5, 2);
    const ProjectionNumbers numbers = stored_in("q3.5", "q1.7", "fp32");
    GaussianCloud rounded = cloud;
    const StoredSh stored(numbers);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        StoredSh::Values room{};
        const float* const read = stored.read(cloud.sh_of(i), 2, room);
        std::copy(read, read + 27, rounded.sh.begin() + static_cast<std::ptrdiff_t>(27 * i));
    }
    const FrameWorkload found = frame_in(cloud, numbers);
    const FrameWorkload wanted = frame_in(rounded, {});
    const FrameWorkload exact = frame_in(cloud, {});
    ASSERT_EQ(found.splats.size(), wanted.splats.size());
    ASSERT_GT(found.splats.size(), 100U);
    EXPECT_EQ(found.tile_splats, exact.tile_splats);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < found.splats.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const double colour = found.splats[i].colour[channel];
            EXPECT_EQ(colour, wanted.splats[i].colour[channel]);
            changed += colour != exact.splats[i].colour[channel] ? 1 : 0;
        }
        EXPECT_EQ(found.splats[i].mu_x, exact.splats[i].mu_x);
        EXPECT_EQ(found.splats[i].q_threshold, exact.splats[i].q_threshold);
    }
    EXPECT_GT(changed, 100U);
}

class DepthKeys : public testing::TestWithParam<const char*> {};

// Splats go by their rounded depth, equal ones by index; depths themselves stay as they are.
TEST_P(DepthKeys, OrderSplats) {
    const GaussianCloud cloud = test::random_cloud(3000, 9);
    const FrameWorkload exact = frame_in(cloud, {});
    const FrameWorkload found = frame_in(cloud, stored_in("fp64", "fp64", GetParam()));
    const Rounder key_of(parse_format(GetParam()));
    std::vector<std::size_t> order(exact.splats.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const double near = key_of(exact.splats[a].depth), far = key_of(exact.splats[b].depth);
        return near < far || (near == far && exact.splats[a].id < exact.splats[b].id);
    });
    ASSERT_EQ(found.splats.size(), exact.splats.size());
    std::size_t moved = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        EXPECT_EQ(found.splats[i].id, exact.splats[order[i]].id);
        EXPECT_EQ(found.splats[i].depth, exact.splats[order[i]].depth);
        moved += order[i] != i ? 1 : 0;
    }
    EXPECT_GT(moved, 10U);
    EXPECT_EQ(found.tile_pairs(), exact.tile_pairs());
    EXPECT_TRUE(std::is_sorted(found.tile_splats.begin(),
                               found.tile_splats.begin() +
                                   static_cast<std::ptrdiff_t>(found.tile_begin[1])));
}

// Some are too narrow for the depths there: the farthest are infinite or the last fixed value.
INSTANTIATE_TEST_SUITE_P(Formats, DepthKeys,
                         testing::Values("bf16", "fp16", "ue4m8b3", "ue3m6b2", "uq4.8", "uq2.6"));

} // namespace
} // namespace degs
