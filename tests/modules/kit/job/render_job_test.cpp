// SPDX-License-Identifier: Apache-2.0
// Frames that have been rendered leave a job; the numbers of frames and tiles go on.
#include "modules/kit/job/render_job.hpp"

#include <gmock/gmock.h>

#include "tests/modules/degs/workload_fixture.hpp"

namespace degs {
namespace {

using test::make_frame;
using test::one_pixel;
using ::testing::ElementsAre;

JobTile tile_of(std::uint32_t frame, bool passed = true) {
    JobTile tile;
    tile.frame = frame;
    tile.passed = passed;
    return tile;
}

TEST(TileList, NumbersAndPlacesStayWhenTheOldestRetire) {
    TileList tiles;
    for (const std::uint32_t frame : {0, 0, 2, 2, 2}) {
        tiles.push_back(tile_of(frame));
    }
    const JobTile* const third = &tiles[2];
    EXPECT_TRUE(tiles.retire(0));
    EXPECT_TRUE(tiles.retire(1)); // which lists nothing
    EXPECT_EQ(tiles.first(), 2U);
    EXPECT_EQ(tiles.size(), 5U);
    EXPECT_EQ(&tiles[2], third);
    EXPECT_EQ(tiles.begin()->frame, 2U);
    EXPECT_TRUE(tiles.retire(2));
    EXPECT_EQ(tiles.begin(), tiles.end());
    EXPECT_FALSE(tiles.empty()); // tiles have joined
    tiles.push_back(tile_of(3));
    tiles.push_back(tile_of(3));
    EXPECT_EQ(tiles.size(), 7U);
    EXPECT_EQ(tiles[5].turn, 0U);
    EXPECT_EQ(tiles[6].turn, 1U);
    EXPECT_EQ(&tiles.back(), &tiles[6]);
}

TEST(TileList, AFrameStaysWhileATileOfItHasNotBeenPassed) {
    TileList tiles;
    tiles.push_back(tile_of(0));
    tiles.push_back(tile_of(0, false));
    tiles.push_back(tile_of(1));
    EXPECT_FALSE(tiles.retire(0));
    EXPECT_EQ(tiles.first(), 0U);
    tiles[1].passed = true;
    EXPECT_TRUE(tiles.retire(0));
    EXPECT_EQ(tiles.first(), 2U);
}

/// Tiles of 16 x 16 px in a row, each with one splat of one pixel.
FrameWorkload row_of(int tiles) {
    std::vector<ProjectedSplat> splats;
    for (int t = 0; t < tiles; ++t) {
        splats.push_back(one_pixel(16 * t + 3, 5));
    }
    return make_frame(splats, 16 * tiles, 16, 16);
}

void pass_all(RenderJob& job) {
    for (std::size_t t = job.tiles.first(); t < job.tiles.size(); ++t) {
        job.tiles[t].passed = true;
    }
}

TEST(RenderJob, RetiredFramesLeaveRoomForOthers) {
    const FrameWorkload frames[] = {row_of(3), row_of(2), row_of(2), row_of(4)};
    RenderJob job = make_render_job({&frames[0], &frames[1]}, DataPathOptions(), 1);
    EXPECT_EQ(job.first_splat[1], 3U);
    pass_all(job);
    job.retire_before(1);
    EXPECT_EQ(job.frames.first(), 1U);
    EXPECT_EQ(job.tiles.first(), 3U);
    job.add(frames[2]);
    job.add(frames[3]);
    EXPECT_EQ(job.first_splat[2], 0U);
    EXPECT_EQ(job.first_splat[3], 5U); // it does not fit below frame 1
    EXPECT_EQ(job.frames.size(), 4U);
    EXPECT_EQ(job.frames[3], &frames[3]);
    EXPECT_THAT(job.tiles_of_frame, ElementsAre(2U, 2U, 4U));
    EXPECT_EQ(job.pairs_before(3, 4), 4U);
    EXPECT_EQ(job.images[3].width, 64);
    EXPECT_EQ(job.map(2, {}).lists, job.map(1, {}).lists);
    EXPECT_EQ(job.tiles.size(), 11U);
    EXPECT_EQ(job.tiles[7].frame, 3U);
    EXPECT_EQ(job.tiles[10].x, 48);
    EXPECT_TRUE(job.tiles[10].last_of_frame);
    EXPECT_EQ(job.sorter_of(8, 4), 1U);
}

TEST(RenderJob, FramesRetireInTheirOrderAndAsFarAsTheyHaveBeenPassed) {
    const FrameWorkload two = row_of(2), none = make_frame({}, 32, 16, 16);
    RenderJob job = make_render_job({&none, &two, &none, &two, &two}, DataPathOptions(), 1);
    job.retire_before(4);
    EXPECT_EQ(job.frames.first(), 1U); // nobody has to pass what lists nothing
    pass_all(job);
    job.tiles[3].passed = false;
    job.retire_before(4);
    EXPECT_EQ(job.frames.first(), 3U);
    EXPECT_EQ(job.tiles.first(), 2U);
    job.tiles[3].passed = true;
    job.retire_before(4);
    EXPECT_EQ(job.frames.first(), 4U);
    job.retire_before(2); // they have
    EXPECT_EQ(job.frames.first(), 4U);
}

} // namespace
} // namespace degs
