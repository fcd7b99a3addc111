// SPDX-License-Identifier: Apache-2.0
// Empty tiles and culled Gaussians cost the blocks behind them nothing.
#include "tests/modules/degs/workload_fixture.hpp"
#include "tests/sim/needed_work/counted_run.hpp"

namespace degs::sim_test {
namespace {

constexpr int kHalf = 256; // px

/// One set of splats, whose pixels all lie in the left half, in an image of that width or twice as
/// wide.
FrameWorkload left_half_in(int width, int tile_size) {
    FrameWorkload frame = test::random_frame(7, kHalf, 96, tile_size, 150);
    std::vector<ProjectedSplat> inside;
    for (const ProjectedSplat& splat : frame.splats) {
        const double reach = std::sqrt(splat.q_threshold * splat.cov_a);
        if (splat.mu_x + reach < kHalf - 1) {
            inside.push_back(splat);
        }
    }
    return test::make_frame(inside, width, 96, tile_size);
}

class NeededTileWork : public testing::TestWithParam<const char*> {};

TEST_P(NeededTileWork, EmptyHalfCostsTheArrayNothing) {
    const sim::RunConfig config = shipped(GetParam());
    const int tile = config.accelerator().tile_size_px();
    BuildOptions array;
    array.array_only = true;
    const Counts half = counted_run(config, left_half_in(kHalf, tile), array);
    const Counts whole = counted_run(config, left_half_in(2 * kHalf, tile), array);
    EXPECT_GT(half["activations"], 0);
    EXPECT_EQ(whole["activations"], half["activations"]);
    EXPECT_EQ(whole["stages"], half["stages"]);
    EXPECT_EQ(whole["tiles"], half["tiles"]);
}

/// The counters of a stage without those that follow from dates, which background writes on the bus
/// move.
Counts work_of(const Counts& stage) {
    Counts work;
    for (const auto& [name, value] : stage.items()) {
        const auto has = [&key = name](const char* word) {
            return key.find(word) != std::string::npos;
        };
        if (!has("cycles") && !has("waits") && !has("packets") && !has("high_water")) {
            work[name] = value;
        }
    }
    return work;
}

// With front end and memory, the background is written: a request per row of pixels of a run of
// tiles, each of which resumes its writer a few times. Everything else does what it does without.
TEST_P(NeededTileWork, EmptyHalfCostsTheFrameItsBackgroundOnly) {
    const sim::RunConfig config = shipped(GetParam());
    const int tile = config.accelerator().tile_size_px();
    const Counts half = counted_run(config, left_half_in(kHalf, tile));
    Counts whole = counted_run(config, left_half_in(2 * kHalf, tile));
    EXPECT_GE(whole["background_tiles"], half["background_tiles"].get<int>() + 96 / tile);
    EXPECT_EQ(whole["tiles"], half["tiles"]);
    for (const auto& [name, stage] : half["stages"].items()) {
        EXPECT_EQ(work_of(whole["stages"][name]), work_of(stage)) << name;
    }
    const auto number = [](const Counts& counts, const char* key) {
        return counts[key].get<double>();
    };
    const double requests = number(whole["streams"]["frame_buffer"], "requests") -
                            number(half["streams"]["frame_buffer"], "requests");
    EXPECT_GT(requests, 0);
    EXPECT_LE(number(whole, "activations"), number(half, "activations") + 4 * requests);
}
INSTANTIATE_TEST_SUITE_P(Designs, NeededTileWork,
                         testing::Values("degs-64", "degs-64-tuned", "gscore-64", "gbu-64"));

constexpr std::size_t kMany = 1000000;

/// One ball in view, in the middle of `others` that are culled for every reason in turn.
GaussianCloud one_among(std::size_t others) {
    GaussianCloud cloud;
    for (std::size_t i = 0; i <= others; ++i) {
        if (i == others / 2) {
            add_ball(cloud, {0, 0, 2}, 0.05F);
        } else if (i % 3 == 0) {
            add_ball(cloud, {0, 0, -1}, 0.05F); // behind the camera
        } else if (i % 3 == 1) {
            add_ball(cloud, {0, 0, 2}, 0.05F, 0.001F); // transparent
        } else {
            add_ball(cloud, {50, 0, 2}, 0.05F); // beside the image
        }
    }
    return cloud;
}

TEST(NeededSplatWork, OneVisibleAmongAMillionCulledIsOneSplat) {
    const sim::RunConfig config = shipped("degs-64");
    const Camera camera = plain_camera(256, 192);
    const FrameWorkload alone = frame_for(config, one_among(0), camera);
    const FrameWorkload among = frame_for(config, one_among(kMany), camera);
    ASSERT_EQ(among.splats.size(), 1U);
    EXPECT_EQ(among.culled.total(), kMany);
    EXPECT_GT(among.culled.near, 0U);
    EXPECT_GT(among.culled.transparent, 0U);
    EXPECT_GT(among.culled.off_screen, 0U);
    // The host's tables reach from the first visible Gaussian to the last.
    EXPECT_EQ(among.visible_of.size(), 1U);
    EXPECT_EQ(among.visible_means.capacity(), 1U);
    EXPECT_EQ(among.tile_splats, alone.tile_splats);

    const Counts one = counted_run(config, alone);
    const Counts million = counted_run(config, among);
    EXPECT_EQ(million["stages"]["projection"]["gaussians"], kMany + 1);
    EXPECT_EQ(million["stages"]["projection"]["visible"], 1);
    for (const auto& [name, stage] : one["stages"].items()) {
        if (name != "projection") {
            EXPECT_EQ(million["stages"][name], stage) << name;
        }
    }
    for (const auto& [name, stream] : one["streams"].items()) {
        if (name != "geometry") {
            EXPECT_EQ(million["streams"][name], stream) << name;
        }
    }
    // Culled Gaussians come in chunks of 64, of which each is read, projected, handed on and
    // dropped.
    const double chunks = kMany / 64.0;
    const double more = million["activations"].get<double>() - one["activations"].get<double>();
    EXPECT_GT(more, chunks);
    EXPECT_LE(more, 8 * chunks);
}

} // namespace
} // namespace degs::sim_test
