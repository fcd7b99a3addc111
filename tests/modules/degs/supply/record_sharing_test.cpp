// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/supply/record_sharing.hpp"

#include <random>

#include <gmock/gmock.h>

#include "tests/modules/degs/workload_fixture.hpp"

namespace degs {
namespace {

using test::make_frame;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Tiles that all list the same splats.
FrameWorkload same_lists(int tiles, int splats) {
    std::vector<ProjectedSplat> all(splats, test::blanket(8 * tiles, 8, 16 * tiles));
    return make_frame(all, 16 * tiles, 16, 16);
}

struct SharingBench {
    FrameWorkload frame;
    RenderJob job;
    RecordSharing sharing;

    SharingBench(FrameWorkload work, std::size_t fetchers, std::size_t window, std::size_t cache)
        : frame(std::move(work)),
          job(make_render_job({&frame},
                              {Arithmetic::Fp64, SpanEnds::Exact, 0, StopRule::Refuse, {}}, 1)),
          sharing(job, fetchers, window, cache) {}

    SplatChunk chunk(TileNumber tile, std::uint64_t begin, std::uint32_t count) const {
        const JobTile& list = job.tiles[tile];
        return {tile, list.first + begin, count, begin + count == list.count};
    }
    /// Fetcher f asks for entries of tile f, which come at `date`; what has to be read for it.
    std::vector<std::uint32_t> ask(std::size_t f, std::uint64_t begin, std::uint32_t count,
                                   Cycle date = 1) {
        std::vector<std::uint32_t> missed =
            sharing.request(f, chunk(static_cast<TileNumber>(f), begin, count));
        last = missed.empty() ? sharing.known() : sharing.complete(date);
        return missed;
    }
    Completion last;
};

TEST(RecordSharing, WithoutWindowAndCacheEverythingIsRead) {
    SharingBench bench(same_lists(2, 6), 2, 0, 0);
    EXPECT_THAT(bench.ask(0, 0, 4), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(bench.ask(1, 0, 4), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(bench.ask(1, 4, 2), ElementsAre(4, 5));
    EXPECT_EQ(bench.sharing.stats().read, 10U);
}

TEST(RecordSharing, OpenWindowsCaptureWhatOthersRead) {
    SharingBench bench(same_lists(3, 12), 3, 4, 0);
    EXPECT_THAT(bench.ask(0, 0, 2, 10), ElementsAre(0, 1));
    EXPECT_THAT(bench.ask(1, 0, 2, 11), ElementsAre(0, 1)); // nothing was known of this tile
    // Fetcher 0 is at entry 2 and has 2 to 5 in its window.
    EXPECT_THAT(bench.ask(1, 2, 3, 12), ElementsAre(2, 3, 4));
    EXPECT_THAT(bench.ask(1, 5, 3, 13), ElementsAre(5, 6, 7));
    EXPECT_THAT(bench.ask(0, 2, 6, 20), ElementsAre(6, 7));
    EXPECT_EQ(bench.last, 20U); // of the captured ones the last came at 13
    EXPECT_EQ(bench.sharing.stats().captured, 4U);
    EXPECT_THAT(bench.ask(1, 8, 4, 30), ElementsAre(8, 9, 10, 11));
    EXPECT_THAT(bench.ask(0, 8, 4), IsEmpty());
    EXPECT_EQ(bench.last, 30U);
    EXPECT_THAT(bench.ask(2, 0, 12), ::testing::SizeIs(12));
    const RecordSharing::Stats& stats = bench.sharing.stats();
    EXPECT_EQ(stats.requested, 36U);
    EXPECT_EQ(stats.read, 28U);
    EXPECT_EQ(stats.captured, 8U);
    EXPECT_EQ(stats.unused, 0U);
}

// Tile 0 ends after its first chunk.
TEST(RecordSharing, AFinishedTileCapturesNothingMore) {
    SharingBench bench(same_lists(2, 9), 2, 8, 0);
    bench.ask(0, 0, 1);
    EXPECT_THAT(bench.ask(1, 0, 4), ElementsAre(0, 1, 2, 3)); // 1, 2, 3 are captured
    bench.sharing.request(0, {0, 1, 0, true});
    EXPECT_EQ(bench.sharing.stats().unused, 3U);
    bench.ask(1, 4, 5);
    EXPECT_EQ(bench.sharing.stats().unused, 3U);
    EXPECT_EQ(bench.sharing.stats().captured, 0U);
}

TEST(RecordSharing, TheCacheReplacesWhatWasUsedLeastRecently) {
    SharingBench bench(same_lists(2, 4), 2, 0, 2);
    EXPECT_THAT(bench.ask(0, 0, 2, 5), ElementsAre(0, 1)); // holds 1, 0
    EXPECT_THAT(bench.ask(1, 0, 1), IsEmpty());            // 0, 1
    EXPECT_EQ(bench.last, 5U);
    EXPECT_THAT(bench.ask(0, 2, 1), ElementsAre(2)); // 2, 0
    EXPECT_THAT(bench.ask(1, 1, 2), ElementsAre(1)); // splat 2 is a hit: 1, 2
    EXPECT_THAT(bench.ask(0, 3, 1), ElementsAre(3));
    EXPECT_THAT(bench.ask(1, 3, 1), IsEmpty());
    EXPECT_EQ(bench.sharing.stats().hits, 3U);
}

class SmallRunRecordSharing : public ::testing::TestWithParam<unsigned> {};

// Against lists of who has asked for what.
TEST_P(SmallRunRecordSharing, NothingIsLostAndALargeCacheReadsEverySplatOnce) {
    std::mt19937 random(GetParam());
    const std::size_t window = random() % 3 * 5, fetchers = 1 + random() % 5;
    const bool large = random() % 2 == 0;
    SharingBench bench(test::random_frame(GetParam(), 90, 70, 16, 60), fetchers, window,
                       large ? 1000 : 0);
    std::vector<TileNumber> tile(fetchers);
    std::vector<std::uint64_t> done(fetchers, 0);
    TileNumber next = 0;
    for (TileNumber& t : tile) {
        t = next++;
    }
    std::uint64_t asked = 0, read = 0;
    std::vector<bool> named(bench.frame.splats.size(), false);
    for (std::size_t f = 0; next < bench.job.tiles.size() + fetchers; f = random() % fetchers) {
        if (tile[f] >= bench.job.tiles.size()) {
            tile[f] = next++;
            continue;
        }
        const std::uint64_t left = bench.job.tiles[tile[f]].count - done[f];
        const auto count = static_cast<std::uint32_t>(std::min<std::uint64_t>(left, 7));
        const SplatChunk chunk = bench.chunk(tile[f], done[f], count);
        for (std::uint32_t i = 0; i < count; ++i) {
            named[bench.frame.tile_splats[chunk.first + i]] = true;
        }
        const std::size_t missed = bench.sharing.request(f, chunk).size();
        if (missed != 0) {
            bench.sharing.complete(1);
        }
        asked += count;
        read += missed;
        done[f] += count;
        if (chunk.last) {
            tile[f] = next++;
            done[f] = 0;
        }
    }
    const RecordSharing::Stats& stats = bench.sharing.stats();
    EXPECT_EQ(stats.requested, asked);
    EXPECT_EQ(stats.read, read);
    EXPECT_EQ(stats.requested, stats.read + stats.captured + stats.hits);
    if (large) {
        EXPECT_EQ(read, static_cast<std::uint64_t>(std::count(named.begin(), named.end(), true)));
    }
    EXPECT_EQ(stats.captured != 0, window != 0 && fetchers > 1) << stats.captured;
}

INSTANTIATE_TEST_SUITE_P(Random, SmallRunRecordSharing, ::testing::Range(0U, 20U));

} // namespace
} // namespace degs
