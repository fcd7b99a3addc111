// SPDX-License-Identifier: Apache-2.0
// Chunks at exact dates. Every ring takes a cycle: request -> reader -> bus -> FIFO -> buffer.
#include "modules/degs/supply/splat_supply.hpp"

#include <random>

#include <gmock/gmock.h>

#include "tests/modules/kit/job/unit_bench.hpp"

namespace degs {
namespace {

using ::testing::ElementsAre;
using Dates = std::vector<Cycle>;

constexpr int kChunk = 4;

/// Tiles that all list the same splats.
FrameWorkload tiles_alike(int tiles, int splats) {
    const std::vector<ProjectedSplat> all(splats, test::blanket(8 * tiles, 8, 16 * tiles));
    return test::make_frame(all, 16 * tiles, 16, 16);
}

SplatSupply::Shape clusters(int count) {
    SplatSupply::Shape shape;
    shape.clusters = count;
    shape.fetching.chunk = kChunk;
    return shape;
}

/// Fetcher f asks for tile f, chunk by chunk.
struct SupplyBench : test::UnitBench {
    std::unique_ptr<SplatSupply> supply;
    std::vector<std::unique_ptr<DatedFifo<SplatChunk>>> requests, buffers;
    std::vector<std::unique_ptr<DatedFifo<ChunkReleased>>> taken;
    std::size_t most;        ///< chunks of a fetcher that the bus has not taken
    std::vector<Dates> read; ///< by fetcher: when its chunks were read from its buffer

    SupplyBench(const std::string& name, FrameWorkload work, const SplatSupply::Config& config,
                const SplatSupply::Shape& shape, double latency_ns = 10,
                Fidelity fidelity = Fidelity::Exact)
        : UnitBench(std::move(work)), most(shape.fetching.chunks_in_flight) {
        time.fidelity = fidelity;
        supply = std::make_unique<SplatSupply>((name + "supply").c_str(), config, TrafficConfig(),
                                               time, job, shape);
        const int fetchers = shape.clusters * shape.fetchers;
        read.resize(fetchers);
        for (int f = 0; f < fetchers; ++f) {
            const std::string number = name + std::to_string(f);
            requests.push_back(
                std::make_unique<DatedFifo<SplatChunk>>(("requests" + number).c_str(), time, 64));
            buffers.push_back(
                std::make_unique<DatedFifo<SplatChunk>>(("buffer" + number).c_str(), time, 1));
            taken.push_back(std::make_unique<DatedFifo<ChunkReleased>>(("taken" + number).c_str(),
                                                                       time, FifoBase::kWire));
            supply->in[f].bind(*requests[f]);
            supply->taken[f].bind(*taken[f]);
            supply->outlet(f).out[0].bind(*buffers[f]);
        }
        memory = std::make_unique<Memory>((name + "memory").c_str(),
                                          Memory::Config{1e9, latency_ns}, time, 1);
        supply->records.out.bind(memory->in[0]);
    }
    /// The reader sees the requests of fetcher f at these dates, unless too many are outstanding.
    void ask(std::size_t f, const Dates& dates) {
        script([this, f, dates](Process& self) {
            requests[f]->connect_writer(self);
            taken[f]->connect_reader(self);
            const JobTile& tile = job.tiles[f];
            for (std::uint64_t i = 0; i < dates.size(); ++i) {
                self.advance_to(dates[i] - 1);
                if (i >= most) {
                    taken[f]->get(self);
                }
                const std::uint32_t count = next_chunk_of(kChunk, tile.count - kChunk * i);
                requests[f]->put(self, {static_cast<TileNumber>(f), tile.first + kChunk * i, count,
                                        kChunk * i + count == tile.count});
            }
        });
    }
    /// Whoever reads buffer f begins at `from` and takes `cycles` per chunk.
    void drain_from(std::size_t f, Cycle from, Cycle cycles = 0) {
        script([this, f, from, cycles](Process& self) {
            buffers[f]->connect_reader(self);
            self.advance_to(from);
            for (;;) {
                buffers[f]->get(self);
                read[f].push_back(self.local());
                self.advance(cycles);
            }
        });
    }
    const RecordSharing::Stats& records() const { return supply->stats().records; }
};

SplatSupply::Config rate(int splats_per_cycle, int fifo_splats = 8) {
    SplatSupply::Config config;
    config.splats_per_cycle = splats_per_cycle;
    config.fifo_splats = fifo_splats;
    return config;
}

// Chosen at 1 to 6 in turn, complete eleven cycles later and on the bus at once, in the FIFO and in
// the buffer a cycle later each.
TEST(SplatSupply, ClustersTakeTurnsOnTheBus) {
    SupplyBench bench("", tiles_alike(2, 12), rate(kChunk), clusters(2));
    for (const std::size_t f : {0U, 1U}) {
        bench.ask(f, {1, 1, 1});
        bench.drain_from(f, 0);
    }
    sc_core::sc_start();
    EXPECT_THAT(bench.read[0], ElementsAre(14, 16, 18));
    EXPECT_THAT(bench.read[1], ElementsAre(15, 17, 19));
    EXPECT_EQ(bench.supply->stats().bus_busy, 6U);
    EXPECT_EQ(bench.supply->stats().bus_wait, 0U);
    EXPECT_EQ(bench.records().read, 24U);
}

// Two splats per cycle: a chunk of four takes two.
TEST(SplatSupply, ASlowBusTakesSeveralCyclesPerChunk) {
    SupplyBench bench("", tiles_alike(2, 8), rate(2), clusters(2));
    for (const std::size_t f : {0U, 1U}) {
        bench.ask(f, {1, 1});
        bench.drain_from(f, 0);
    }
    sc_core::sc_start();
    EXPECT_THAT(bench.read[0], ElementsAre(15, 19));
    EXPECT_THAT(bench.read[1], ElementsAre(17, 21));
    EXPECT_EQ(bench.supply->stats().bus_busy, 8U);
    EXPECT_EQ(bench.supply->stats().bus_wait, 0U + 1 + 2 + 3);
}

// Six per cycle: chunks of four use cycles 2, 2 and 3, 3, 4, 4 and 5, 5.
TEST(SplatSupply, ChunksShareACycleOfAFastBus) {
    SplatSupply::Shape shape = clusters(3);
    shape.instant = true;
    SupplyBench bench("", tiles_alike(3, 8), rate(6), shape);
    for (const std::size_t f : {0U, 1U, 2U}) {
        bench.ask(f, {1, 1});
        bench.drain_from(f, 0);
    }
    sc_core::sc_start();
    EXPECT_THAT(bench.read[0], ElementsAre(4, 6));
    EXPECT_THAT(bench.read[1], ElementsAre(5, 7));
    EXPECT_THAT(bench.read[2], ElementsAre(5, 7));
    EXPECT_EQ(bench.supply->stats().bus_busy, 4U);
}

// The buffer of cluster 0 holds a chunk and its FIFO two, and nobody reads before 100.
TEST(SplatSupply, AFullClusterIsSkipped) {
    SupplyBench bench("", tiles_alike(2, 24), rate(kChunk), clusters(2));
    bench.ask(0, {1, 1, 1, 1});
    bench.ask(1, {1, 1, 1, 1, 1, 1});
    bench.drain_from(0, 100);
    bench.drain_from(1, 0);
    sc_core::sc_start();
    EXPECT_THAT(bench.read[1], ElementsAre(15, 17, 19, 21, 22, 23));
    EXPECT_THAT(bench.read[0], ElementsAre(100, 101, 102, 103));
    EXPECT_EQ(bench.supply->stats().room_wait, 101U - 18);
}

TEST(SplatSupply, AnUnlimitedBusDeliversAllAtOnce) {
    SplatSupply::Config config = rate(0, 64);
    config.cache_bytes = 1;
    SplatSupply::Shape shape = clusters(3);
    shape.instant = true;
    SupplyBench bench("", tiles_alike(3, 4), config, shape);
    for (const std::size_t f : {0U, 1U, 2U}) {
        bench.ask(f, {1});
        bench.drain_from(f, 0);
    }
    sc_core::sc_start();
    for (const Dates& dates : bench.read) {
        EXPECT_THAT(dates, ElementsAre(4));
    }
}

// Fetcher 1 opens its window at 2 and takes nothing of the first chunk. At 5 fetcher 0 reads for
// both, at 30 fetcher 1 does.
TEST(SplatSupply, WindowsCaptureWhatIsReadForOthers) {
    SplatSupply::Config config = rate(0);
    config.multicast_window = 8;
    SupplyBench bench("", tiles_alike(2, 12), config, clusters(2));
    bench.ask(0, {1, 5, 31});
    bench.ask(1, {2, 20, 30});
    bench.drain_from(0, 0);
    bench.drain_from(1, 0);
    sc_core::sc_start();
    EXPECT_THAT(bench.read[0], ElementsAre(14, 18, 43)); // the last with 41, read for fetcher 1
    EXPECT_THAT(bench.read[1], ElementsAre(15, 23, 43)); // the second was there at 16
    EXPECT_EQ(bench.records().requested, 24U);
    EXPECT_EQ(bench.records().read, 16U);
    EXPECT_EQ(bench.records().captured, 8U);
    EXPECT_EQ(bench.memory->stats(0).reads, 4U);
}

TEST(SplatSupply, WhatLiesBehindTheWindowIsReadAgain) {
    SplatSupply::Config config = rate(0);
    config.multicast_window = 2;
    SupplyBench bench("", tiles_alike(2, 12), config, clusters(2));
    bench.ask(0, {1, 5, 31});
    bench.ask(1, {2, 20, 30});
    bench.drain_from(0, 0);
    bench.drain_from(1, 0);
    sc_core::sc_start();
    EXPECT_THAT(bench.read[0], ElementsAre(14, 18, 44)); // asks for two of the last four at 31
    EXPECT_THAT(bench.read[1], ElementsAre(15, 33, 43));
    EXPECT_EQ(bench.records().read, 16U + 4);
    EXPECT_EQ(bench.records().captured, 4U);
}

// Four records stay: each chunk of fetcher 1 comes before the next of fetcher 0.
TEST(SplatSupply, TheCacheServesAllClusters) {
    SplatSupply::Config config = rate(0);
    config.cache_bytes = kChunk * TrafficConfig().splat_bytes;
    SupplyBench bench("", tiles_alike(2, 8), config, clusters(2));
    bench.ask(0, {1, 40});
    bench.ask(1, {5, 60});
    bench.drain_from(0, 0);
    bench.drain_from(1, 0);
    sc_core::sc_start();
    EXPECT_THAT(bench.read[0], ElementsAre(14, 53));
    EXPECT_THAT(bench.read[1], ElementsAre(14, 63)); // the first with the records on their way
    EXPECT_EQ(bench.records().read, 8U);
    EXPECT_EQ(bench.records().hits, 8U);
}

// Two chunks may be outstanding: the bus takes the first chunk at 12, its fetcher knows at 13, and
// the reader at 14.
TEST(SplatSupply, RequestsOutstandingAreBounded) {
    SplatSupply::Shape shape = clusters(1);
    shape.fetching.chunks_in_flight = 2;
    SupplyBench bench("", tiles_alike(1, 16), rate(kChunk, 64), shape);
    bench.ask(0, {1, 1, 1, 1});
    bench.drain_from(0, 0);
    sc_core::sc_start();
    EXPECT_THAT(bench.read[0], ElementsAre(14, 15, 27, 28));
}

TEST(SplatSupply, TheArrayAloneKeepsTheRateOfTheBus) {
    SplatSupply::Shape shape = clusters(2);
    shape.instant = true;
    SupplyBench bench("", tiles_alike(2, 8), rate(1), shape, 1000);
    for (const std::size_t f : {0U, 1U}) {
        bench.ask(f, {1, 1});
        bench.drain_from(f, 0);
    }
    sc_core::sc_start();
    EXPECT_THAT(bench.read[0], ElementsAre(7, 15));
    EXPECT_THAT(bench.read[1], ElementsAre(11, 19));
    EXPECT_EQ(bench.memory->stats(0).reads, 0U);
}

class SmallRunSplatSupply : public ::testing::TestWithParam<unsigned> {};

TEST_P(SmallRunSplatSupply, ExactIsStrictAndNothingIsLost) {
    std::mt19937 random(GetParam());
    const auto among = [&random](std::initializer_list<int> values) {
        return values.begin()[random() % values.size()];
    };
    const SplatSupply::Config drawn{among({0, 1, 3, 4, 9}), among({4, 16, 40}), among({0, 3, 16}),
                                    among({0, 128, 2048})};
    SplatSupply::Shape shape = clusters(among({1, 2, 4}));
    shape.fetchers = among({1, 2});
    shape.fetching.chunks_in_flight = among({1, 2, 8});
    shape.instant = among({0, 0, 1}) != 0;
    const double latency = among({0, 3, 40});
    const FrameWorkload frame = tiles_alike(shape.clusters * shape.fetchers, 33);
    SupplyBench exact("exact", frame, drawn, shape, latency, Fidelity::Exact);
    SupplyBench strict("strict", frame, drawn, shape, latency, Fidelity::Strict);
    for (std::size_t f = 0; f < exact.read.size(); ++f) {
        Dates dates;
        Cycle date = 1 + random() % 5;
        for (int i = 0; i < 9; ++i) {
            dates.push_back(date);
            date += random() % 3 * (random() % 9);
        }
        const Cycle from = random() % 60, cycles = random() % 12;
        for (SupplyBench* bench : {&exact, &strict}) {
            bench->ask(f, dates);
            bench->drain_from(f, from, cycles);
        }
    }
    sc_core::sc_start();
    EXPECT_EQ(exact.read, strict.read);
    for (const Dates& dates : exact.read) {
        EXPECT_EQ(dates.size(), 9U);
    }
    const SplatSupply::Stats a = exact.supply->stats(), b = strict.supply->stats();
    EXPECT_EQ(a.records.requested, 33U * exact.read.size());
    EXPECT_EQ(a.records.requested, a.records.read + a.records.captured + a.records.hits);
    EXPECT_EQ(a.records.read, b.records.read);
    EXPECT_EQ(a.records.captured, b.records.captured);
    EXPECT_EQ(a.records.hits, b.records.hits);
    EXPECT_EQ(a.bus_busy, b.bus_busy);
    EXPECT_EQ(a.bus_wait, b.bus_wait);
    EXPECT_EQ(a.room_wait, b.room_wait);
    EXPECT_EQ(exact.memory->stats(0).bytes_read, strict.memory->stats(0).bytes_read);
}

INSTANTIATE_TEST_SUITE_P(Random, SmallRunSplatSupply, ::testing::Range(0U, 60U));

} // namespace
} // namespace degs
