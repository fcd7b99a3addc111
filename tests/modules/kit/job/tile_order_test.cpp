// SPDX-License-Identifier: Apache-2.0
// Tiles by the length of their lists: the order in the job, and what it does to a run.
#include "modules/kit/job/tile_order.hpp"

#include <gmock/gmock.h>

#include "tests/modules/degs/run_fixture.hpp"

namespace degs {
namespace {

using test::DegsRun;
using test::one_pixel;
using ::testing::ElementsAre;

/// A row of tiles of 16 x 16 px with so many splats each.
FrameWorkload tiles_of(const std::vector<int>& counts) {
    std::vector<ProjectedSplat> splats;
    for (std::size_t t = 0; t < counts.size(); ++t) {
        for (int i = 0; i < counts[t]; ++i) {
            splats.push_back(one_pixel(16 * static_cast<int>(t) + 3 + i % 8, 5));
        }
    }
    return test::make_frame(splats, 16 * static_cast<int>(counts.size()), 16, 16);
}

TEST(TileOrder, LongestListsComeFirstAndEqualOnesInRasterOrder) {
    const FrameWorkload frame = tiles_of({2, 0, 5, 2, 7, 5, 0});
    EXPECT_THAT(listed_tiles(frame, TileOrder::Raster), ElementsAre(0, 2, 3, 4, 5));
    EXPECT_THAT(listed_tiles(frame, TileOrder::LongestList), ElementsAre(4, 2, 5, 0, 3));
    EXPECT_TRUE(listed_tiles(tiles_of({0, 0}), TileOrder::LongestList).empty());
}

TEST(TileOrder, TheJobHoldsTheTilesOfEveryFrameInItsOrder) {
    const FrameWorkload one = tiles_of({2, 0, 5, 2}), two = tiles_of({1, 3, 0, 1});
    DegsConfig config;
    config.tile_size = 16;
    config.tile_order = TileOrder::LongestList;
    const RenderJob job = make_render_job({&one, &two}, config);
    std::vector<int> columns;
    std::vector<std::uint64_t> counts, before, first;
    std::vector<bool> last;
    for (const JobTile& tile : job.tiles) {
        columns.push_back(tile.x / 16);
        counts.push_back(tile.count);
        before.push_back(tile.before);
        first.push_back(tile.first);
        last.push_back(tile.last_of_frame);
    }
    EXPECT_THAT(columns, ElementsAre(2, 0, 3, 1, 0, 3));
    EXPECT_THAT(counts, ElementsAre(5, 2, 2, 3, 1, 1));
    EXPECT_THAT(before, ElementsAre(0, 5, 7, 0, 3, 4));
    EXPECT_THAT(first, ElementsAre(2, 0, 7, 1, 0, 4)); // lists stay where they are in memory
    EXPECT_THAT(last, ElementsAre(false, false, true, false, false, true));
    EXPECT_THAT(job.tiles_of_frame, ElementsAre(3U, 3U));
}

// Three tile streams; the last tile in raster order is as long as all others together.
TEST(TileOrder, ALongTileAtTheEndNoLongerHoldsUpTheFrame) {
    const FrameWorkload frame = tiles_of({100, 100, 100, 100, 100, 100, 600});
    DegsConfig config = test::exact_arithmetic();
    config.tile_size = 16;
    config.slicing.interleave = config.slicing.count = 3;
    config.pixel_buffer.bytes = 3 * config.pixel_buffer.state_bytes * 16 * 16;
    DegsConfig sorted = config;
    sorted.tile_order = TileOrder::LongestList;
    BuildOptions alone;
    alone.array_only = true;
    const DegsRun raster("raster", config, {&frame}, Fidelity::Exact, alone);
    const DegsRun longest("longest", sorted, {&frame}, Fidelity::Exact, alone);
    sc_core::sc_start();
    for (const DegsRun* run : {&raster, &longest}) {
        test::expect_sound(*run);
        test::expect_reference(*run);
    }
    EXPECT_LT(longest.degs().finished() * 5, raster.degs().finished() * 4);
}

class SmallRunTileOrder : public ::testing::TestWithParam<unsigned> {};

TEST_P(SmallRunTileOrder, ExactIsStrictAndTheImageStays) {
    const unsigned seed = GetParam();
    const FrameWorkload one = test::random_frame(seed, 130, 70, 16, 250);
    const FrameWorkload two = test::random_frame(seed + 100, 70, 130, 16, 90);
    DegsConfig config = test::exact_arithmetic();
    config.tile_size = 16;
    config.tile_order = TileOrder::LongestList;
    config.slicing.interleave = config.slicing.count = 1 + static_cast<int>(seed % 2);
    config.pixel_buffer.bytes = 2 * config.pixel_buffer.state_bytes * 16 * 16;
    const DegsRun exact("exact", config, {&one, &two}, Fidelity::Exact);
    const DegsRun strict("strict", config, {&one, &two}, Fidelity::Strict);
    sc_core::sc_start();
    test::expect_sound(exact);
    test::expect_reference(exact);
    test::expect_same_statistics(exact, strict);
}

INSTANTIATE_TEST_SUITE_P(Random, SmallRunTileOrder, ::testing::Range(0U, 4U));

} // namespace
} // namespace degs
