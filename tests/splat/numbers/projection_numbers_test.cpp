// SPDX-License-Identifier: Apache-2.0
// Gaussians and depth keys in formats of their own.
#include "splat/numbers/projection_numbers.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "splat/frame/stored_gaussians.hpp"
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

/// A format of its own for every part.
ProjectionNumbers narrow_records() {
    ProjectionNumbers numbers = stored_in("q3.5", "q1.7", "fp32");
    numbers.mean = parse_format("fp16");
    numbers.scale = parse_format("ue4m6b12");
    numbers.rotation = parse_format("q1.7");
    numbers.opacity = parse_format("uq0.8");
    return numbers;
}

GaussianCloud rounded(const GaussianCloud& cloud, const ProjectionNumbers& numbers) {
    const StoredGaussians stored(cloud, numbers);
    GaussianCloud copy = cloud;
    const std::size_t values = 3 * cloud.sh_coefficients();
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        copy.means[i] = stored.mean(i);
        copy.scales[i] = glm::vec3(stored.scale(i));
        copy.rotations[i] = glm::vec4(stored.rotation(i));
        copy.opacities[i] = static_cast<float>(stored.opacity(i));
        StoredGaussians::Sh room{};
        const float* const read = stored.sh(i, room);
        std::copy(read, read + values, &copy.sh[values * i]);
    }
    return copy;
}

TEST(StoredGaussians, HaveTheirBits) {
    const ProjectionNumbers reference;
    EXPECT_EQ(reference.mean_bits(), 96);
    EXPECT_EQ(reference.shape_bits(), 256);
    EXPECT_EQ(reference.sh_bits(0), 96);
    EXPECT_EQ(reference.sh_bits(3), 48 * 32);
    const ProjectionNumbers narrow = narrow_records();
    EXPECT_EQ(narrow.mean_bits(), 48);
    EXPECT_EQ(narrow.shape_bits(), 3 * 10 + 4 * 8 + 8);
    EXPECT_EQ(narrow.sh_bits(1), 12 * 8);
    EXPECT_TRUE(reference.keeps_gaussians());
    EXPECT_FALSE(narrow.keeps_gaussians());
}

TEST(StoredGaussians, AreRoundedPartByPart) {
    GaussianCloud cloud = test::random_cloud(200, 5, 1);
    const float given[12] = {5, 0.51F, -0.1F, 0.004F, 0.0038F, -3, 2, 0.5F, 0, 1e-9F, -0.3F, 0.1F};
    std::copy(given, given + 12, cloud.sh.begin());
    cloud.opacities[0] = 0.5034F;
    cloud.rotations[0] = {0.5F, -0.5F, 0.7F, 0.104F};
    cloud.scales[0] = {1.0F, 0.011F, 3.03F};
    cloud.means[0] = {1.0003, -2.0004, 5};
    const StoredGaussians stored(cloud, narrow_records());
    StoredGaussians::Sh room{};
    const float* const read = stored.sh(0, room);
    EXPECT_EQ(read[0], 127.0F / 32); // saturates
    EXPECT_EQ(read[1], 0.5F);
    EXPECT_EQ(read[2], -3.0F / 32);
    EXPECT_EQ(read[3], 1.0F / 128); // 0.512 units
    EXPECT_EQ(read[4], 0.0F);       // 0.486 units
    EXPECT_EQ(read[5], -127.0F / 128);
    EXPECT_EQ(read[6], 127.0F / 128);
    EXPECT_EQ(stored.opacity(0), 129.0 / 256);
    EXPECT_EQ(stored.rotation(0), glm::dvec4(0.5, -0.5, 90.0 / 128, 13.0 / 128));
    EXPECT_EQ(stored.scale(0), glm::dvec3(1, 90.0 / 8192, 97.0 / 32));
    EXPECT_EQ(stored.mean(0).x, 1.0);
    EXPECT_EQ(stored.mean(0).y, -2.0);
    const StoredGaussians untouched(cloud, ProjectionNumbers());
    EXPECT_EQ(untouched.sh(0, room), cloud.sh_of(0));
    EXPECT_EQ(untouched.mean(0), cloud.means[0]);
    EXPECT_EQ(untouched.opacity(0), static_cast<double>(cloud.opacities[0]));
}

// Rounding happens in the scene's own frame, where it surrounds the origin, else about its middle.
TEST(StoredGaussians, KeepScenesThatLieFarAway) {
    const GaussianCloud near = test::random_cloud(500, 4);
    GaussianCloud far = near;
    const glm::dvec3 shift(1e6, 0, -3e5);
    for (glm::dvec3& mean : far.means) {
        mean += shift;
    }
    const StoredGaussians at_home(near, narrow_records()), abroad(far, narrow_records());
    double worst = 0;
    for (std::size_t i = 0; i < near.size(); ++i) {
        const glm::dvec3 error = abroad.mean(i) - far.means[i];
        worst = std::max({worst, std::abs(error.x), std::abs(error.y), std::abs(error.z)});
        EXPECT_EQ(abroad.mean(i).y, at_home.mean(i).y);
    }
    double reach = 0;
    for (const glm::dvec3& mean : near.means) {
        reach = std::max({reach, std::abs(mean.x), std::abs(mean.z)});
    }
    EXPECT_LE(worst, 2 * reach / 2048); // half a unit of FP16 at twice the reach
    EXPECT_GT(worst, 0.0);
}

// The splats are those of a scene whose file holds the rounded values.
TEST(StoredGaussians, MakeTheSplatsOfARoundedScene) {
    const GaussianCloud cloud = test::random_cloud(800, 5, 2);
    const FrameWorkload found = frame_in(cloud, narrow_records());
    const FrameWorkload wanted = frame_in(rounded(cloud, narrow_records()), {});
    const FrameWorkload exact = frame_in(cloud, {});
    ASSERT_EQ(found.splats.size(), wanted.splats.size());
    ASSERT_GT(found.splats.size(), 100U);
    EXPECT_EQ(found.tile_splats, wanted.tile_splats);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < found.splats.size(); ++i) {
        const ProjectedSplat& splat = found.splats[i];
        EXPECT_EQ(splat.id, wanted.splats[i].id);
        EXPECT_EQ(splat.mu_x, wanted.splats[i].mu_x);
        EXPECT_EQ(splat.cov_b, wanted.splats[i].cov_b);
        EXPECT_EQ(splat.q_threshold, wanted.splats[i].q_threshold);
        EXPECT_EQ(splat.colour[1], wanted.splats[i].colour[1]);
        moved += i < exact.splats.size() && splat.mu_x != exact.splats[i].mu_x ? 1 : 0;
    }
    EXPECT_GT(moved, 100U);
}

TEST(StoredGaussians, ThatDoNotFitTheFormatAreCounted) {
    GaussianCloud cloud = test::random_cloud(100, 4);
    cloud.scales[5] = {1e6F, 1, 1};
    EXPECT_EQ(StoredGaussians(cloud, narrow_records()).scale(5).x,
              narrow_records().scale.max()); // a scale saturates
    cloud.means[7] = {0, 0, 1e6};            // FP16 ends at 65 504
    const FrameWorkload found = frame_in(cloud, narrow_records());
    EXPECT_EQ(found.culled.degenerate, 1U);
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
