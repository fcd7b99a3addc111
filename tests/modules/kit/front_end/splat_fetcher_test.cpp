// SPDX-License-Identifier: Apache-2.0
// The Splat Fetcher alone: how many requests are outstanding, against a closed formula.
#include "modules/kit/front_end/splat_fetcher.hpp"

#include "tests/modules/kit/job/unit_bench.hpp"

namespace degs {
namespace {

using test::one_pixel_splats;
using test::UnitBench;

class ChunksInFlight : public ::testing::TestWithParam<int> {};

// Six chunks of 16 records, and a memory that answers in the cycle after 100 others. A request goes
// out every second cycle, but not before the one `chunks` before it has been answered.
TEST_P(ChunksInFlight, LimitTheRequests) {
    constexpr Cycle kAnswer = 101;
    const auto chunks = static_cast<std::size_t>(GetParam());
    UnitBench bench(one_pixel_splats(96));
    SplatFetcher::Config config;
    config.chunks_in_flight = GetParam();
    SplatFetcher unit("unit", config, {}, bench.time, bench.job, 1, false);
    DatedFifo<SortedRun> sorted("sorted", bench.time, 1);
    DatedFifo<TileNumber> cancel("cancel", bench.time, 4);
    DatedFifo<SplatChunk> out("out", bench.time, 64);
    unit.sorted.bind(sorted);
    unit.cancel.bind(cancel);
    unit.out[0].bind(out);
    bench.connect({&unit.records}, 100);
    bench.script([&](Process& self) {
        sorted.connect_writer(self);
        sorted.put(self, {0, 96});
        sorted.put(self, {kNoTile, 0});
    });
    bench.script([&](Process& self) { cancel.connect_writer(self); });
    const auto& got = bench.drain(out);
    sc_core::sc_start();
    ASSERT_EQ(got.size(), 6U);
    std::vector<Cycle> asked;
    for (std::size_t k = 0; k < got.size(); ++k) {
        Cycle date = k == 0 ? got[0].first - kAnswer - 1 : asked[k - 1] + 2;
        date = k < chunks ? date : std::max(date, asked[k - chunks] + kAnswer);
        asked.push_back(date);
        EXPECT_EQ(got[k].first, date + kAnswer + 1) << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Chunks, ChunksInFlight, ::testing::Values(1, 2, 3, 8));

} // namespace
} // namespace degs
