// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/span_engine/parameter_release.hpp"

#include "modules/kit/front_end/splat_fetcher.hpp"
#include "tests/modules/kit/job/unit_bench.hpp"

namespace degs {
namespace {

using test::make_frame;
using test::one_pixel;
using test::UnitBench;

/// Two lanes, two fetchers, and wires of one cycle to and from the module.
struct ReleaseBench {
    UnitBench bench{make_frame({one_pixel(0, 0)}, 16, 16, 16)};
    ParameterRelease unit{"unit", bench.time, 2, 2};
    DatedFifo<ChunkSliced> sliced{"sliced", bench.time, 16};
    DatedFifo<RowCount> counts[2]{{"counts0", bench.time, 16}, {"counts1", bench.time, 16}};
    DatedFifo<RowSolved> solved[2]{{"solved0", bench.time, 64}, {"solved1", bench.time, 64}};
    DatedFifo<ChunkReleased> places[2]{{"places0", bench.time, 16}, {"places1", bench.time, 16}};

    ReleaseBench() {
        unit.sliced.bind(sliced);
        for (std::size_t i = 0; i < 2; ++i) {
            unit.rows[i].bind(counts[i]);
            unit.solved[i].bind(solved[i]);
            unit.released[i].bind(places[i]);
        }
    }
    /// A chunk whose last row is sent at `date`.
    void slice(Process& self, Cycle date, std::size_t fetcher, std::uint32_t first_lane,
               std::uint32_t second_lane) {
        self.advance_to(date);
        sliced.put(self, {fetcher});
        counts[0].put(self, {first_lane});
        counts[1].put(self, {second_lane});
    }
    void solve(std::size_t lane, const std::vector<Cycle>& dates) {
        bench.script([this, lane, dates](Process& self) {
            for (const Cycle date : dates) {
                self.advance_to(date);
                solved[lane].put(self, {});
            }
        });
    }
};

// The first chunk has three rows, solved at 12, 13 and 30; the second one none, but it comes after
// the first; the third has its only row before it is reported. Each is released two wires later.
TEST(ParameterRelease, AChunkLeavesWhenItsLastRowHasBeenSolved) {
    ReleaseBench release;
    release.bench.script([&](Process& self) {
        release.slice(self, 10, 0, 2, 1);
        release.slice(self, 11, 1, 0, 0);
        release.slice(self, 50, 0, 0, 1);
    });
    release.solve(0, {12, 13});
    release.solve(1, {30, 40});
    const auto& first = release.bench.drain(release.places[0]);
    const auto& second = release.bench.drain(release.places[1]);
    sc_core::sc_start();
    ASSERT_EQ(first.size(), 2U);
    ASSERT_EQ(second.size(), 1U);
    EXPECT_EQ(first[0].first, 32U);
    EXPECT_EQ(second[0].first, 32U);
    EXPECT_EQ(first[1].first, 52U);
}

// Two places, chunks of one splat: the third and the fourth chunk wait until a place is free.
TEST(ParameterRelease, AFetcherWaitsForAPlace) {
    UnitBench bench(make_frame(std::vector<ProjectedSplat>(4, one_pixel(0, 0)), 16, 16, 16));
    SplatFetcher::Config config;
    config.chunk = 1;
    config.chunks = 2;
    SplatFetcher fetcher("fetcher", config, {}, bench.time, bench.job, 1, true);
    bench.connect({&fetcher.records});
    DatedFifo<SortedRun> sorted("sorted", bench.time, 1);
    DatedFifo<TileNumber> cancel("cancel", bench.time, 4, 8);
    DatedFifo<SplatChunk> out("out", bench.time, 64);
    DatedFifo<ChunkReleased> places("places", bench.time, 16);
    fetcher.sorted.bind(sorted);
    fetcher.cancel.bind(cancel);
    fetcher.out[0].bind(out);
    fetcher.released[0].bind(places);
    bench.script([&](Process& self) {
        self.advance(9);
        sorted.put(self, {0, 4});
    });
    bench.script([&](Process& self) { cancel.connect_writer(self); });
    bench.script([&](Process& self) {
        for (const Cycle date : {20, 33}) {
            self.advance_to(date);
            places.put(self, {});
        }
    });
    const auto& got = bench.drain(out);
    sc_core::sc_start();
    ASSERT_EQ(got.size(), 4U);
    EXPECT_EQ(got[0].first, 11U);
    EXPECT_EQ(got[1].first, 11U);
    EXPECT_EQ(got[2].first, 22U);
    EXPECT_EQ(got[3].first, 35U);
}

// Writing a chunk of 16 splats takes 16 cycles with one port, and half of it with two.
class FetcherPorts : public ::testing::TestWithParam<std::tuple<int, int, Cycle>> {};

TEST_P(FetcherPorts, WriteSplatsOneAfterTheOther) {
    const auto [ports, sram_banks, cycles] = GetParam();
    UnitBench bench(make_frame(std::vector<ProjectedSplat>(48, one_pixel(0, 0)), 16, 16, 16));
    SplatFetcher::Config config;
    config.splat_ports.ports = ports;
    config.splat_ports.sram_banks = sram_banks;
    SplatFetcher fetcher("fetcher", config, {}, bench.time, bench.job, 1, true);
    bench.connect({&fetcher.records});
    DatedFifo<SortedRun> sorted("sorted", bench.time, 1);
    DatedFifo<TileNumber> cancel("cancel", bench.time, 4, 8);
    DatedFifo<SplatChunk> out("out", bench.time, 64);
    fetcher.sorted.bind(sorted);
    fetcher.cancel.bind(cancel);
    fetcher.out[0].bind(out);
    bench.script([&](Process& self) {
        self.advance(9);
        sorted.put(self, {0, 48});
    });
    bench.script([&](Process& self) { cancel.connect_writer(self); });
    const auto& got = bench.drain(out);
    sc_core::sc_start();
    ASSERT_EQ(got.size(), 3U);
    for (Cycle i = 0; i < 3; ++i) {
        EXPECT_EQ(got[i].first, 11 + i * cycles);
    }
}

INSTANTIATE_TEST_SUITE_P(Ports, FetcherPorts,
                         ::testing::Values(std::tuple(0, 1, 0), std::tuple(1, 1, 16),
                                           std::tuple(2, 1, 8), std::tuple(1, 3, 6)));

} // namespace
} // namespace degs
