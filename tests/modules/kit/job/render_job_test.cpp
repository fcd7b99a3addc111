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
    job.add(borrowed(frames[2]));
    job.add(borrowed(frames[3]));
    EXPECT_EQ(job.first_splat[2], 0U);
    EXPECT_EQ(job.first_splat[3], 5U); // it does not fit below frame 1
    EXPECT_EQ(job.frames.size(), 4U);
    EXPECT_EQ(job.frames[3].get(), &frames[3]);
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

/// A job of DeGS's data path without frames, which come from `frames`.
RenderJob job_from(const std::vector<const FrameWorkload*>& frames, std::uint32_t views = 1) {
    RenderJob job = make_render_job(DataPathOptions(), 16, 1);
    job.views = views;
    job.source = source_of(frames);
    return job;
}

// A tile that is asked for brings the frames up to it; nothing is made for one that is there.
TEST(RenderJob, FramesAreMadeWhenTheyAreAskedFor) {
    const FrameWorkload none = make_frame({}, 32, 16, 16), two = row_of(2), three = row_of(3);
    RenderJob job = job_from({&two, &none, &three, &two});
    EXPECT_TRUE(job.has_more_frames_than(3));
    EXPECT_FALSE(job.has_more_frames_than(4));
    EXPECT_EQ(job.frames.size(), 0U);
    EXPECT_FALSE(job.over(1));
    EXPECT_EQ(job.frames.size(), 1U);
    EXPECT_TRUE(job.lists(2)); // the second frame lists nothing
    EXPECT_EQ(job.frames.size(), 3U);
    EXPECT_EQ(job.background_tiles, 2U);
    EXPECT_FALSE(job.over(4));
    EXPECT_EQ(job.frames.size(), 3U);
    EXPECT_TRUE(job.over(7));
    EXPECT_EQ(job.tiles.size(), 7U);
    EXPECT_EQ(job.tiles.entries(), 7U);
    EXPECT_EQ(job.tiles.pixels(), 7U * 16 * 16);
    EXPECT_FALSE(job.add_next());
}

// Each frame ends with two messages for each tile and one of its own; the last one that has ended
// stays for those after it.
TEST(RenderJob, FramesThatHaveEndedRetireWhenOthersCome) {
    const FrameWorkload one = row_of(1);
    RenderJob job = job_from({&one, &one, &one, &one, &one});
    job.ends.of_tile = 2;
    job.ends.of_frame = 1;
    const auto next = [&job](int messages, std::uint32_t frame) {
        for (int i = 0; i < messages; ++i) {
            job.note_end(frame);
        }
        EXPECT_TRUE(job.add_next());
        pass_all(job);
        return job.frames.first();
    };
    EXPECT_EQ(next(0, 0), 0U);
    EXPECT_EQ(next(2, 0), 0U); // a message is missing
    EXPECT_EQ(next(3, 1), 0U); // the one before has not ended
    EXPECT_EQ(next(1, 0), 1U);
    EXPECT_EQ(next(3, 2), 2U);
    EXPECT_EQ(job.images.first(), 0U); // for the result
    EXPECT_EQ(job.images.size(), 5U);
}

TEST(RenderJob, ViewsThatAreReadTogetherComeAndRetireTogether) {
    const FrameWorkload one = row_of(1);
    RenderJob job = job_from({&one, &one, &one, &one, &one, &one}, 2);
    EXPECT_TRUE(job.has_more_frames_than(2));
    EXPECT_FALSE(job.has_more_frames_than(3));
    EXPECT_TRUE(job.add_next());
    EXPECT_EQ(job.frames.size(), 2U);
    EXPECT_TRUE(job.add_next());
    pass_all(job);
    for (const std::uint32_t frame : {0, 1, 2}) {
        job.note_end(frame);
    }
    EXPECT_TRUE(job.add_next());
    EXPECT_EQ(job.frames.size(), 6U);
    EXPECT_EQ(job.frames.first(), 1U); // lists of view 3 are kept from it
}

// How many views a frame has is a fact of each frame.
TEST(RenderJob, FramesOfAnyNumberOfViewsFollowEachOther) {
    const FrameWorkload one = row_of(1), two = row_of(2);
    RenderJob job = make_render_job(DataPathOptions(), 16, 1);
    EXPECT_FALSE(job.has_more_frames_than(1));
    job.is_open = true;
    EXPECT_TRUE(job.has_more_frames_than(64));
    job.is_open = false;
    const auto views = [&](std::size_t count) {
        job.add_together(std::vector<FramePointer>(count, borrowed(two)));
    };
    views(2);
    views(3);
    views(3);
    job.add(borrowed(one));
    EXPECT_TRUE(job.has_more_frames_than(3));
    EXPECT_FALSE(job.has_more_frames_than(4));
    std::vector<std::uint32_t> first, count;
    std::vector<int> before;
    for (std::uint32_t frame = 0; frame < 9; ++frame) {
        first.push_back(job.first_view_of(frame));
        count.push_back(job.views_of(frame));
        before.push_back(static_cast<int>(job.view_before(frame).value_or(~0U)));
    }
    EXPECT_THAT(first, ElementsAre(0U, 0U, 2U, 2U, 2U, 5U, 5U, 5U, 8U));
    EXPECT_THAT(count, ElementsAre(2U, 2U, 3U, 3U, 3U, 3U, 3U, 3U, 1U));
    EXPECT_THAT(before, ElementsAre(-1, -1, -1, -1, -1, 2, 3, 4, -1));
    job.first_since_reset = 5;
    EXPECT_FALSE(job.view_before(5).has_value());
    const std::uint64_t apart = job.map(4, {}).splats - job.map(3, {}).splats;
    EXPECT_EQ(job.map(3, {}).splats, job.map(2, {}).splats + apart);
    EXPECT_EQ(job.map(5, {}).splats, job.map(2, {}).splats); // each frame begins anew
    EXPECT_GT(apart, 0U);
}

// Somebody who gives places to views gives them to each.
TEST(RenderJob, ViewsWithPlacesOfTheirOwnStayThere) {
    const FrameWorkload one = row_of(1);
    RenderJob job = make_render_job(DataPathOptions(), 16, 1);
    MemoryBases left, right;
    left.given = right.given = true;
    left.workspace = right.workspace = 0x1000;
    right.ahead = 0x400;
    left.frame_buffer = 0x8000;
    right.frame_buffer = 0x4000;
    job.add_together({borrowed(one), borrowed(one)}, {left, right});
    EXPECT_EQ(job.map(0, {}).splats, 0x1000U);
    EXPECT_EQ(job.map(1, {}).splats, 0x1400U);
    EXPECT_EQ(job.map(1, {}).frame_buffer, 0x4000U);
}

TEST(RenderJob, ASourceMayEndEarly) {
    const FrameWorkload one = row_of(1);
    RenderJob job = job_from({&one, &one, &one});
    job.source.next = [&one, left = 1]() mutable { return left-- == 0 ? nullptr : borrowed(one); };
    EXPECT_TRUE(job.over(1));
    EXPECT_EQ(job.frames.size(), 1U);
    EXPECT_EQ(job.source.frames, 0U);
}

} // namespace
} // namespace degs
