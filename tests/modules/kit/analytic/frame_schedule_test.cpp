// SPDX-License-Identifier: Apache-2.0
// The schedule of tiles, and the cycles of sorters, against dates worked out by hand.
#include "modules/kit/analytic/frame_schedule.hpp"

#include <gtest/gtest.h>

#include "modules/kit/analytic/front_end_load.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

/// A design that only sorts, a cycle per entry in each of two steps, and has engines.
class SortingOnly : public AnalyticModel {
public:
    SortingOnly(int sorters, int engines, double run = 0)
        : sorters_(sorters), engines_(engines), run_(run) {}
    std::vector<std::string> units() const override { return {"memory"}; }
    PreparationCycles preparation(const FrameWorkload&) const override { return {}; }
    std::unique_ptr<TileClock> clock(const FrameWorkload&) const override { return nullptr; }
    CoarseTile::Options coarse_options() const override { return {}; }
    Blocks blocks() const override { return {}; }
    int sorters() const override { return sorters_; }
    SortCycles sort_cycles(double entries, double) const override {
        SortCycles sort;
        sort.first_step = entries * cycles_per_entry;
        sort.first = sort.all = 2 * sort.first_step; // no splat is fetched before
        sort.run = run_;
        return sort;
    }
    int engines() const override { return engines_; }
    double memory_latency() const override { return fetching; }
    Places places() const override { return fetched; }
    TileCycles background(double) const override { return {}; }
    double latency() const override { return 0; }
    int pes() const override { return 1; }
    std::vector<cost::Activity> activity(const FrameWorkload&, const PreparationCycles&,
                                         const TileCycles&) const override {
        return {};
    }
    const MainMemoryConfig& main_memory() const override { return memory_; }

    double cycles_per_entry = 1, fetching = 0;
    Places fetched;

private:
    int sorters_, engines_;
    double run_;
    MainMemoryConfig memory_;
};

double end_of(const AnalyticModel& model, const std::vector<double>& lists) {
    std::vector<ScheduledTile> tiles;
    for (const double entries : lists) {
        ScheduledTile tile;
        tile.entries = entries;
        tile.cycles.time = 1;
        tiles.push_back(tile);
    }
    return schedule(model, tiles, {});
}

// A list is in the first step while the one before is in the second.
TEST(FrameSchedule, StepsOfASorterOverlap) {
    const SortingOnly model(1, 1);
    EXPECT_EQ(end_of(model, {100}), 201);
    EXPECT_EQ(end_of(model, {100, 100, 100}), 401);
}

TEST(FrameSchedule, AListWaitsForTheSlowerStep) {
    const SortingOnly model(1, 1);
    EXPECT_EQ(end_of(model, {10, 100}), 211) << "10 and 100 of the first step, 100 of the second";
    EXPECT_EQ(end_of(model, {100, 10}), 211) << "the second step has 100 and 10";
}

// The short list is complete long before it is its turn.
TEST(FrameSchedule, EnginesAreGrantedTilesInTurn) {
    EXPECT_EQ(end_of(SortingOnly(2, 2), {1000, 10}), 2001);
    EXPECT_EQ(end_of(SortingOnly(2, 2), {1000, 10, 10, 10}), 2011)
        << "the next list of a sorter waits until the one before is with the dispatcher";
}

// The dispatcher takes the list before at 2000. Until then one run of the 40 entries waits in the
// FIFO and one in the sorter; a list of two runs is complete at once.
TEST(FrameSchedule, RunsWaitBehindACompleteList) {
    const std::vector<double> lists{1000, 40, 1, 40};
    EXPECT_EQ(end_of(SortingOnly(2, 2), lists), 2041);
    EXPECT_EQ(end_of(SortingOnly(2, 2, 10), lists), 2021);
    EXPECT_EQ(end_of(SortingOnly(2, 2, 20), lists), 2002)
        << "the list of one entry, sorted at 2001";
}

/// Splats come from memory after 1000 cycles, and lists are sorted in no time.
double end_of_fetched(int engines, const AnalyticModel::Places& places,
                      const std::vector<ScheduledTile>& tiles) {
    SortingOnly model(1, engines);
    model.cycles_per_entry = 0;
    model.fetching = 1000;
    model.fetched = places;
    return schedule(model, tiles, {});
}

ScheduledTile tile_of(double entries, double walked, double time) {
    ScheduledTile tile;
    tile.entries = entries;
    tile.cycles.walked = walked;
    tile.cycles.time = time;
    return tile;
}

// With two places a fetcher has two short lists on their way per latency, and long ones always.
TEST(FrameSchedule, AFetcherIsAheadByItsPlaces) {
    const std::vector<ScheduledTile> lists(8, tile_of(1, 1, 10));
    EXPECT_EQ(end_of_fetched(1, {1, 1}, lists), 8 * 1010);
    EXPECT_EQ(end_of_fetched(1, {2, 1}, lists), 4 * 1010 + 10);
    EXPECT_EQ(end_of_fetched(1, {8, 1}, lists), 1000 + 8 * 10);
    EXPECT_EQ(end_of_fetched(2, {1, 1}, lists), 4 * 1010) << "a fetcher for each engine";
}

// The first splat of a list has been taken after 200 of 400 cycles.
TEST(FrameSchedule, AFetcherFillsItsPlacesWithWhatNobodyTakes) {
    const auto end_of_two = [](std::size_t places, double entries) {
        return end_of_fetched(1, {places, 1}, {tile_of(entries, 2, 400), tile_of(1, 1, 10)});
    };
    EXPECT_EQ(end_of_two(2, 2), 1000 + 200 + 1000 + 10);
    EXPECT_EQ(end_of_two(2, 3), 1000 + 400 + 1000 + 10) << "the third splat has the free place";
    EXPECT_EQ(end_of_two(3, 9), 1000 + 400 + 1000 + 10);
    EXPECT_EQ(end_of_two(3, 2), 1000 + 400 + 10);
}

FrontEndLoad front_of(std::uint64_t capacity) {
    MainMemoryConfig config;
    MemoryRate rate(config, 1);
    rate.bytes_per_cycle = 64;
    rate.latency = 100;
    FrontEndLoad front(rate);
    front.traffic.list_entry_bytes = 8;
    front.sort_capacity = capacity;
    return front;
}

// 8 chunks of 16 splats are on their way, and 32 have places. Memory moves a record per cycle; the
// list and the pixels of the tile are small.
TEST(Fetched, PlacesFillWhileMemoryIsFasterThanTheArray) {
    GaussianCloud cloud;
    for (int i = 0; i < 2000; ++i) {
        test::add_gaussian(cloud, {0, 0, 4 + 0.001F * static_cast<float>(i)}, glm::vec3(0.2F),
                           test::kNoTurn, 0.01F, {1, 1, 1});
    }
    const FrameWorkload frame =
        make_frame_workload(cloud, test::make_camera(8, 8, 10), 8, TileMode::Box);
    CoarseTile tile(frame, {8, 1});
    tile.begin(0, {});
    ASSERT_EQ(tile.entries(), 2000);
    FrontEndLoad front = front_of(1024);
    front.places = 32 * 16;
    front.traffic.splat_bytes = front.traffic.burst_bytes = 64;
    front.traffic.list_entry_bytes = front.traffic.pixel_bytes = 0;
    EXPECT_NEAR(front.fetched(tile, 1000, 1e9, 1), 1000 + 512, 1e-3);
    EXPECT_EQ(front.fetched(tile, 1000, 2000, 1), 1000 + 128 + 192);
    EXPECT_EQ(front.fetched(tile, 1000, 1000, 1), 1000 + 128);
    EXPECT_EQ(front.fetched(tile, 1000, 2000, 2), 1000 + 128) << "half of the memory";
    EXPECT_EQ(front.fetched(tile, 1900, 1e9, 1), 2000);
}

// 16 runs of 64 keys, each in 6 passes of 2 ways, are merged in 4 passes through memory, and each
// writes and reads 8 KB.
TEST(SortCycles, PassesThroughMemoryWaitForIt) {
    SortingUnit::Config config;
    config.keys_per_cycle = 1;
    config.merge_ways = 2;
    const auto inside = sort_cycles(config, 1024, front_of(1024));
    EXPECT_EQ(inside.outside, 0);
    EXPECT_EQ(inside.all, 10 * 1024);
    const auto through = sort_cycles(config, 1024, front_of(64));
    EXPECT_EQ(through.outside, 4);
    EXPECT_EQ(through.busy, 10 * 1024);
    EXPECT_EQ(through.all, 10 * 1024 + 4 * 2 * (100 + 128));
}

// 1024 keys are parted twice into chunks of 256, the first time through memory: the loader has read
// the list, so that it is written once, and the second step reads four chunks.
TEST(SortCycles, LevelsThroughMemoryWaitForIt) {
    HierarchicalSorter::Config config;
    config.chunk = 256;
    config.keys_per_cycle = 2;
    config.fine_cycles_per_key = 2;
    const auto sort = sort_cycles(config, 1024, 1024, front_of(512));
    EXPECT_EQ(sort.outside, 1);
    EXPECT_EQ(sort.first_step, 2 * 512 + 100 + 128);
    EXPECT_EQ(sort.first, sort.first_step + 512 + 100 + 32);
    EXPECT_EQ(sort.all, sort.first_step + 2048 + 4 + 4 * (100 + 32));
}

} // namespace
} // namespace degs
