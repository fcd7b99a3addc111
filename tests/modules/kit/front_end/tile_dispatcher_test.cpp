// SPDX-License-Identifier: Apache-2.0
// Grants at exact dates. Rings take a cycle: what is put in cycle t is seen in t + 1.
#include "modules/kit/front_end/tile_dispatcher.hpp"

#include "modules/kit/front_end/list_collector.hpp"

#include "tests/modules/kit/job/unit_bench.hpp"

namespace degs {
namespace {

using test::make_frame;
using test::one_pixel;

FrameWorkload row_of_tiles(int tiles) {
    std::vector<ProjectedSplat> splats;
    for (int t = 0; t < tiles; ++t) {
        splats.push_back(one_pixel(16 * t + 3, 5));
        splats.push_back(one_pixel(16 * t + 9, 5));
    }
    return make_frame(splats, 16 * tiles, 16, 16);
}

/// Scripts that sort and ask at chosen dates; who got which tile, and when it could be read.
struct DispatcherBench : test::UnitBench {
    struct Grant {
        Cycle date;
        TileNumber tile;
        bool operator==(const Grant& o) const { return date == o.date && tile == o.tile; }
    };
    TileDispatcher dispatcher;
    std::vector<std::unique_ptr<DatedFifo<SortedRun>>> lists, grants;
    std::vector<std::unique_ptr<DatedFifo<TileRequest>>> requests;
    std::vector<std::vector<Grant>> granted;

    DispatcherBench(int tiles, std::size_t inputs, std::size_t engines)
        : UnitBench(row_of_tiles(tiles)), dispatcher("dispatcher", time, job, inputs, engines),
          granted(engines) {
        for (std::size_t i = 0; i < inputs; ++i) {
            lists.push_back(std::make_unique<DatedFifo<SortedRun>>(
                ("lists" + std::to_string(i)).c_str(), time, 8));
            dispatcher.in[i].bind(*lists[i]);
        }
        for (std::size_t e = 0; e < engines; ++e) {
            const std::string number = std::to_string(e);
            requests.push_back(
                std::make_unique<DatedFifo<TileRequest>>(("asked" + number).c_str(), time, 2));
            grants.push_back(
                std::make_unique<DatedFifo<SortedRun>>(("grants" + number).c_str(), time, 2));
            dispatcher.request[e].bind(*requests[e]);
            dispatcher.out[e].bind(*grants[e]);
        }
    }
    /// Tile t is readable at dates[t].
    void sort_at(const std::vector<Cycle>& dates) {
        for (std::size_t i = 0; i < lists.size(); ++i) {
            script([this, i, dates](Process& self) {
                lists[i]->connect_writer(self);
                for (std::size_t t = i; t < dates.size(); t += lists.size()) {
                    self.advance_to(dates[t] - 1);
                    lists[i]->put(self, {static_cast<TileNumber>(t), job.tiles[t].count});
                }
            });
        }
    }
    /// Engine e asks so that its request is readable at `first`, then `work` cycles after each
    /// grant.
    void engine(std::size_t e, Cycle first, Cycle work) {
        script([this, e, first, work](Process& self) {
            requests[e]->connect_writer(self);
            self.advance_to(first - 1);
            for (;;) {
                requests[e]->put(self, {});
                const SortedRun run = grants[e]->get(self);
                if (run.tile == kNoTile) {
                    return;
                }
                granted[e].push_back({self.local(), run.tile});
                self.advance(work);
            }
        });
    }
};

using Grants = std::vector<DispatcherBench::Grant>;

TEST(TileDispatcher, WhoAsksFirstGetsTheNextTile) {
    DispatcherBench bench(2, 1, 2);
    bench.sort_at({1, 1});
    bench.engine(0, 9, 100);
    bench.engine(1, 5, 100);
    sc_core::sc_start();
    EXPECT_EQ(bench.granted[1], (Grants{{6, 0}}));
    EXPECT_EQ(bench.granted[0], (Grants{{10, 1}}));
    EXPECT_EQ(bench.dispatcher.stats().request_wait, 4U + 3);
}

TEST(TileDispatcher, OfThoseWhoAskTogetherTheFirstEngine) {
    DispatcherBench bench(3, 1, 3);
    bench.sort_at({1, 1, 1});
    for (const std::size_t e : {2U, 0U, 1U}) {
        bench.engine(e, 4, 100);
    }
    sc_core::sc_start();
    // One grant per cycle.
    EXPECT_EQ(bench.granted[0], (Grants{{5, 0}}));
    EXPECT_EQ(bench.granted[1], (Grants{{6, 1}}));
    EXPECT_EQ(bench.granted[2], (Grants{{7, 2}}));
}

TEST(TileDispatcher, WhoHasWaitedLongestComesFirstWhenAListIsLate) {
    DispatcherBench bench(3, 2, 3);
    bench.sort_at({1, 50, 20}); // tile 2 is ready earlier, but tiles go in order
    bench.engine(0, 8, 100);
    bench.engine(1, 3, 100);
    bench.engine(2, 1, 100);
    sc_core::sc_start();
    EXPECT_EQ(bench.granted[2], (Grants{{2, 0}}));
    EXPECT_EQ(bench.granted[1], (Grants{{51, 1}}));
    EXPECT_EQ(bench.granted[0], (Grants{{52, 2}}));
}

// Else the engines that end a frame first would begin the next one, and its dates would be others
// than after a reset.
TEST(TileDispatcher, AFrameBeginsWithTheLowestIndexWhoeverHasWaited) {
    DispatcherBench bench(2, 2, 2);
    bench.sort_at({50, 20});
    bench.engine(0, 8, 100);
    bench.engine(1, 3, 100);
    sc_core::sc_start();
    EXPECT_EQ(bench.granted[0], (Grants{{51, 0}}));
    EXPECT_EQ(bench.granted[1], (Grants{{52, 1}}));
    EXPECT_EQ(bench.dispatcher.stats().list_wait, 50U);
}

TEST(TileDispatcher, AFastEngineTakesMoreTiles) {
    DispatcherBench bench(8, 3, 2);
    bench.sort_at(std::vector<Cycle>(8, 1));
    bench.engine(0, 1, 10);
    bench.engine(1, 1, 35);
    sc_core::sc_start();
    // Engine 0 asks again 10 cycles after a grant; two rings make its turn 12 cycles.
    EXPECT_EQ(bench.granted[0], (Grants{{2, 0}, {14, 2}, {26, 3}, {38, 4}, {50, 6}, {62, 7}}));
    EXPECT_EQ(bench.granted[1], (Grants{{3, 1}, {40, 5}}));
    EXPECT_EQ(bench.dispatcher.stats().tiles, 8U);
}

// One list waits behind the collector; of the next it takes nothing before there is room.
TEST(ListCollector, HandsOverAListWhenAllOfItIsInOrder) {
    test::UnitBench bench(row_of_tiles(3));
    DatedFifo<SortedRun> runs("runs", bench.time, 1);
    DatedFifo<SortedRun> lists("lists", bench.time, 1);
    ListCollector collector("collector", bench.time, bench.job);
    collector.in.bind(runs);
    collector.out.bind(lists);
    std::vector<Cycle> sent;
    bench.script([&](Process& self) {
        runs.connect_writer(self);
        for (TileNumber t = 0; t < 3; ++t) {
            for (std::uint64_t end = 1; end <= 2; ++end) {
                self.advance(10);
                runs.put(self, {t, end});
                sent.push_back(self.local());
            }
        }
        runs.put(self, {kNoTile, 0});
    });
    std::vector<std::pair<Cycle, SortedRun>> got;
    bench.script([&](Process& self) {
        lists.connect_reader(self);
        for (SortedRun list = lists.get(self); list.tile != kNoTile; list = lists.get(self)) {
            got.emplace_back(self.local(), list);
            self.advance_to(100);
            self.advance(20);
        }
    });
    sc_core::sc_start();
    ASSERT_EQ(got.size(), 3U);
    EXPECT_EQ(got[0].first, 22U); // the second run at 20, two rings
    EXPECT_EQ(got[1].first, 120U);
    for (TileNumber t = 0; t < 3; ++t) {
        EXPECT_EQ(got[t].second.tile, t);
        EXPECT_EQ(got[t].second.end, 2U);
    }
    // Tile 1 is complete at 41; the first run of tile 2 waits in the ring until its list is taken.
    EXPECT_EQ(sent, (std::vector<Cycle>{10, 20, 30, 40, 50, 120}));
}

} // namespace
} // namespace degs
