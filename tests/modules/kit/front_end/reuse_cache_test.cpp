// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/reuse_cache.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/modules/degs/workload_fixture.hpp"

namespace degs {
namespace {

/// A frame that is nothing but lists of splats by tile.
FrameWorkload lists_of(const std::vector<std::vector<std::uint32_t>>& lists, std::size_t splats) {
    FrameWorkload frame;
    frame.splats.resize(splats);
    frame.tile_size = 16;
    frame.tiles_x = static_cast<int>(lists.size());
    frame.tiles_y = 1;
    frame.camera.width = 16 * frame.tiles_x;
    frame.camera.height = 16;
    frame.tile_begin.push_back(0);
    for (const auto& list : lists) {
        frame.tile_splats.insert(frame.tile_splats.end(), list.begin(), list.end());
        frame.tile_begin.push_back(frame.tile_splats.size());
    }
    return frame;
}

RenderJob job_of(const std::vector<const FrameWorkload*>& frames,
                 TileOrder order = TileOrder::Raster) {
    RenderJob job;
    for (std::uint32_t f = 0; f < frames.size(); ++f) {
        job.frames.push_back(borrowed(*frames[f]));
        std::uint64_t before = 0;
        for (const int t : listed_tiles(*frames[f], order)) {
            JobTile tile;
            tile.frame = f;
            tile.first = frames[f]->tile_begin[t];
            tile.count = frames[f]->tile_begin[t + 1] - tile.first;
            tile.before = before;
            before += tile.count;
            job.tiles.push_back(tile);
        }
    }
    return job;
}

FrameWorkload random_lists(unsigned seed, std::size_t splats, int tiles, int length) {
    std::mt19937 random(seed);
    std::vector<std::vector<std::uint32_t>> lists;
    for (int t = 0; t < tiles; ++t) {
        std::vector<std::uint32_t> all(splats);
        for (std::uint32_t i = 0; i < splats; ++i) {
            all[i] = i;
        }
        std::shuffle(all.begin(), all.end(), random);
        all.resize(std::min(splats, static_cast<std::size_t>(1 + random() % length)));
        lists.push_back(all);
    }
    return lists_of(lists, splats);
}

/// Looks through the rest of the frame at every step.
struct BruteForce {
    const FrameWorkload& frame;
    std::size_t capacity;
    std::vector<std::uint32_t> resident;

    std::size_t use_from(std::size_t entry, std::uint32_t splat) const {
        const auto at = std::find(frame.tile_splats.begin() + static_cast<std::ptrdiff_t>(entry),
                                  frame.tile_splats.end(), splat);
        return static_cast<std::size_t>(at - frame.tile_splats.begin());
    }
    /// Entries [first, end) of one tile; returns the misses.
    std::uint32_t tile(std::size_t first, std::size_t end) {
        std::uint32_t missed = 0;
        for (std::size_t entry = first; entry < end; ++entry) {
            const std::uint32_t splat = frame.tile_splats[entry];
            const auto found = std::find(resident.begin(), resident.end(), splat);
            if (found == resident.end()) {
                ++missed;
                resident.push_back(splat);
            }
            const auto farther = [&](std::uint32_t a, std::uint32_t b) {
                return use_from(entry + 1, a) < use_from(entry + 1, b);
            };
            if (resident.size() > capacity) {
                resident.erase(std::max_element(resident.begin(), resident.end(), farther));
            }
        }
        return missed;
    }
};

std::size_t missed(ReuseCache& cache, TileNumber tile, std::uint64_t first, std::uint64_t count) {
    return cache.request(tile, first, static_cast<std::uint32_t>(count)).size();
}

std::uint64_t misses_of(const FrameWorkload& frame, std::size_t capacity,
                        TileOrder order = TileOrder::Raster) {
    const RenderJob job = job_of({&frame}, order);
    NextUses uses(job);
    ReuseCache cache(job, uses, capacity);
    for (TileNumber t = 0; t < job.tiles.size(); ++t) {
        cache.request(t, job.tiles[t].first, static_cast<std::uint32_t>(job.tiles[t].count));
    }
    return cache.stats().misses;
}

TEST(ReuseCache, NextUseNamesTheNextEntryOfTheSameSplat) {
    const FrameWorkload frame = lists_of({{0, 1, 2}, {1}, {2, 0}}, 3);
    const NextUse uses(job_of({&frame}), 0);
    const std::uint32_t none = NextUse::kNone;
    const std::vector<std::uint32_t> expected{5, 3, 4, none, none, none};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(uses.after(i), expected[i]) << i;
    }
}

// Tiles come as {0, 1, 2}, {2, 0}, {1}.
TEST(ReuseCache, NextUseFollowsTheTileOrder) {
    const FrameWorkload frame = lists_of({{1}, {0, 1, 2}, {2, 0}}, 3);
    const NextUse uses(job_of({&frame}, TileOrder::LongestList), 0);
    const std::uint32_t none = NextUse::kNone;
    const std::vector<std::uint32_t> expected{4, 5, 3, none, none, none};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(uses.after(i), expected[i]) << i;
    }
}

// A frame whose tiles lie in the image by falling length of their lists.
TEST(ReuseCache, OrderCountsAndNotWhereListsLie) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const FrameWorkload frame = random_lists(300 + seed, 20, 15, 18);
        std::vector<std::vector<std::uint32_t>> lists;
        for (const int t : listed_tiles(frame, TileOrder::LongestList)) {
            const auto at = frame.tile_splats.begin();
            lists.emplace_back(at + static_cast<std::ptrdiff_t>(frame.tile_begin[t]),
                               at + static_cast<std::ptrdiff_t>(frame.tile_begin[t + 1]));
        }
        const FrameWorkload sorted = lists_of(lists, 20);
        for (const std::size_t capacity : {1U, 3U, 7U}) {
            EXPECT_EQ(misses_of(frame, capacity, TileOrder::LongestList),
                      misses_of(sorted, capacity))
                << "seed " << seed << ", " << capacity << " records";
        }
    }
}

TEST(ReuseCache, KeepsWhatIsUsedSoonest) {
    // One record: of the first tile's splats the one that tile 1 wants stays, read first or last.
    EXPECT_EQ(misses_of(lists_of({{0, 1}, {1}, {0}}, 2), 1), 3U);
    EXPECT_EQ(misses_of(lists_of({{1, 0}, {1}, {0}}, 2), 1), 3U);
    EXPECT_EQ(misses_of(lists_of({{0, 1}, {1}, {0}}, 2), 2), 2U);
}

TEST(ReuseCache, EveryFirstUseOfASplatIsAMissAndALargeCacheHasNoOthers) {
    const FrameWorkload frame = random_lists(3, 40, 30, 25);
    std::vector<std::uint32_t> named = frame.tile_splats;
    std::sort(named.begin(), named.end());
    const auto distinct = std::unique(named.begin(), named.end()) - named.begin();
    EXPECT_EQ(misses_of(frame, 40), static_cast<std::uint64_t>(distinct));
}

TEST(ReuseCache, HitsAsOftenAsAnOptimalCacheThatSeesTheFuture) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        const FrameWorkload frame = random_lists(seed, 4 + seed, 12, 20);
        const RenderJob job = job_of({&frame});
        NextUses uses(job);
        for (const std::size_t capacity : {1U, 2U, 3U, 7U, 16U}) {
            ReuseCache cache(job, uses, capacity);
            BruteForce brute{frame, capacity, {}};
            for (TileNumber t = 0; t < job.tiles.size(); ++t) {
                const JobTile& tile = job.tiles[t];
                EXPECT_EQ(missed(cache, t, tile.first, tile.count),
                          brute.tile(tile.first, tile.first + tile.count))
                    << "seed " << seed << ", " << capacity << " records, tile " << t;
            }
        }
    }
}

// With tiles left to other engines: a use in a tile that has been passed counts no more.
TEST(ReuseCache, PassedTilesAreNoUses) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        const FrameWorkload frame = random_lists(100 + seed, 4 + seed, 20, 12);
        const RenderJob job = job_of({&frame});
        NextUses uses(job);
        ReuseCache cache(job, uses, 5);
        BruteForce brute{frame, 5, {}};
        std::mt19937 random(seed);
        for (TileNumber t = 0; t < job.tiles.size();
             t += 1 + static_cast<TileNumber>(random() % 3)) {
            const JobTile& tile = job.tiles[t];
            EXPECT_EQ(missed(cache, t, tile.first, tile.count),
                      brute.tile(tile.first, tile.first + tile.count))
                << "seed " << seed << ", tile " << t;
        }
    }
}

TEST(ReuseCache, MoreRoomNeverHitsLess) {
    for (unsigned seed = 0; seed < 10; ++seed) {
        const FrameWorkload frame = random_lists(200 + seed, 200, 40, 90);
        std::uint64_t before = frame.tile_pairs() + 1;
        for (std::size_t capacity = 1; capacity <= 256; capacity *= 2) {
            const std::uint64_t misses = misses_of(frame, capacity);
            EXPECT_LE(misses, before) << "seed " << seed << ", " << capacity << " records";
            before = misses;
        }
    }
}

TEST(ReuseCache, ChunksOfAListAndCancelledRestsChangeNothingElse) {
    const FrameWorkload frame = lists_of({{0, 1, 2, 3}, {0, 1, 2, 3}, {3, 2, 1, 0}}, 4);
    const RenderJob job = job_of({&frame});
    NextUses uses(job);
    ReuseCache cache(job, uses, 4);
    EXPECT_EQ(missed(cache, 0, 0, 2), 2U);
    EXPECT_EQ(missed(cache, 0, 2, 1), 1U); // the tile ends here: splat 3 is never read
    EXPECT_EQ(missed(cache, 1, 4, 4), 1U);
    EXPECT_EQ(missed(cache, 2, 8, 4), 0U);
    EXPECT_EQ(cache.stats().hits, 7U);
}

TEST(ReuseCache, NamesTheSplatsThatItMisses) {
    const FrameWorkload frame = lists_of({{2, 0}, {0, 1, 2, 3}}, 4);
    const RenderJob job = job_of({&frame});
    NextUses uses(job);
    ReuseCache cache(job, uses, 4);
    EXPECT_EQ(cache.request(0, 0, 2), (std::vector<std::uint32_t>{2, 0}));
    EXPECT_EQ(cache.request(1, 2, 4), (std::vector<std::uint32_t>{1, 3}));
}

TEST(ReuseCache, FramesShareNothing) {
    const FrameWorkload one = lists_of({{0, 1}, {0, 1}}, 2);
    const FrameWorkload two = lists_of({{1, 0}, {1, 0}}, 2);
    const RenderJob job = job_of({&one, &two});
    NextUses uses(job);
    ReuseCache cache(job, uses, 8);
    EXPECT_EQ(missed(cache, 0, 0, 2), 2U);
    EXPECT_EQ(missed(cache, 1, 2, 2), 0U);
    EXPECT_EQ(missed(cache, 2, 0, 2), 2U);
    EXPECT_EQ(missed(cache, 3, 2, 2), 0U);
}

// The other tile of the first frame is that of another cache: what is kept for it is of no use to
// the second.
TEST(ReuseCache, AFrameLeavesNothingForTheNext) {
    const FrameWorkload frame = lists_of({{0, 1}, {0, 1}}, 2);
    const RenderJob job = job_of({&frame, &frame});
    NextUses uses(job);
    ReuseCache cache(job, uses, 8);
    EXPECT_EQ(missed(cache, 0, 0, 2), 2U);
    EXPECT_EQ(missed(cache, 2, 0, 2), 2U);
    EXPECT_EQ(missed(cache, 3, 2, 2), 0U);
}

} // namespace
} // namespace degs
