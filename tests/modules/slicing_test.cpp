// SPDX-License-Identifier: Apache-2.0
// Slicing Units alone: dates against closed formulas.
#include <algorithm>

#include "modules/span_engine/gaussian_slicing_unit.hpp"
#include "tests/modules/unit_bench.hpp"

namespace degs {
namespace {

using test::blanket;
using test::make_frame;
using test::one_pixel;
using test::one_row;
using test::UnitBench;

class Slicing : public ::testing::TestWithParam<int> {};

// `rows_per_cycle` rows of a splat per cycle, a new splat in a new cycle.
TEST_P(Slicing, RowsPerCycle) {
    UnitBench bench(
        make_frame({blanket(8, 8, 32), one_pixel(3, 4), blanket(8, 8, 32)}, 16, 16, 16));
    GaussianSlicingUnit::Config config;
    config.count = 1;
    config.rows_per_cycle = GetParam();
    GaussianSlicingUnit unit("unit", config, bench.time, bench.job, 0, 1, 1, 0, 16);
    DatedFifo<SplatChunk> chunks("chunks", bench.time, 4);
    DatedFifo<TileNumber> cancel("cancel", bench.time, 4);
    DatedFifo<RowItem> rows("rows", bench.time, 256);
    unit.in[0].bind(chunks);
    unit.cancel.bind(cancel);
    unit.out[0].bind(rows);
    bench.script([&](Process& self) {
        chunks.connect_writer(self);
        self.advance(9);
        SplatChunk chunk;
        chunk.count = 3;
        chunk.last = true;
        chunks.put(self, chunk);
    });
    bench.script([&](Process& self) { cancel.connect_writer(self); });
    const auto& got = bench.drain(rows);
    sc_core::sc_start();
    ASSERT_EQ(got.size(), 16U + 1 + 16 + 1);
    const auto per_cycle = static_cast<Cycle>(GetParam());
    const Cycle blanket_cycles = (16 + per_cycle - 1) / per_cycle;
    for (Cycle i = 0; i < 16; ++i) {
        EXPECT_EQ(got[i].first, 10 + i / per_cycle + 1); // the ring takes a cycle
        EXPECT_EQ(got[i].second.row, static_cast<int>(i));
        EXPECT_EQ(got[17 + i].first, 10 + blanket_cycles + 1 + i / per_cycle + 1);
    }
    EXPECT_EQ(got[16].first, 10 + blanket_cycles + 1);
    EXPECT_EQ(got[16].second.row, 4);
    EXPECT_TRUE(got.back().second.end);
    EXPECT_EQ(unit.stats().rows, 33U);
    EXPECT_EQ(unit.stats().busy, 2 * blanket_cycles + 1);
}

INSTANTIATE_TEST_SUITE_P(Rates, Slicing, ::testing::Values(1, 3, 4, 16));

/// A slicing stage of `count` units that share out the splats of one tile, with a lane per row.
struct SharedSlicing {
    UnitBench bench;
    GaussianSlicingUnit::Config config;
    std::unique_ptr<GaussianSlicingUnit> unit;
    DatedFifo<SplatChunk> chunks{"chunks", bench.time, 4};
    DatedFifo<TileNumber> cancel{"cancel", bench.time, 4};
    std::vector<std::unique_ptr<DatedFifo<RowItem>>> lanes;
    std::vector<std::vector<std::pair<Cycle, RowItem>>*> got;

    SharedSlicing(const std::vector<ProjectedSplat>& splats, int size, int count,
                  int splats_per_cycle = 1)
        : bench(make_frame(splats, size, size, size)) {
        config.count = count;
        config.splats_per_cycle = splats_per_cycle;
        config.distribution = SliceDistribution::Splats;
        unit = std::make_unique<GaussianSlicingUnit>("unit", config, bench.time, bench.job, 0, 1,
                                                     size, 0, 16);
        unit->in[0].bind(chunks);
        unit->cancel.bind(cancel);
        for (int row = 0; row < size; ++row) {
            lanes.push_back(std::make_unique<DatedFifo<RowItem>>(
                ("lane" + std::to_string(row)).c_str(), bench.time, 4096));
            unit->out[row].bind(*lanes.back());
        }
        bench.script([this, count = splats.size()](Process& self) {
            chunks.connect_writer(self);
            self.advance(9);
            SplatChunk chunk;
            chunk.count = static_cast<std::uint32_t>(count);
            chunk.last = true;
            chunks.put(self, chunk);
        });
        bench.script([this](Process& self) { cancel.connect_writer(self); });
        for (auto& lane : lanes) {
            got.push_back(&bench.drain(*lane));
        }
    }
    /// The cycles at which the rows of a lane were sent: the first splat is there at 10, and the
    /// ring takes a cycle.
    std::vector<Cycle> sent(int row) const {
        std::vector<Cycle> dates;
        for (const auto& [date, item] : *got[row]) {
            if (!item.end) {
                dates.push_back(date - 11);
            }
        }
        return dates;
    }
    /// The splats of a lane's rows, in the order in which they were sent.
    std::vector<std::uint32_t> splats(int row) const {
        std::vector<std::uint32_t> list;
        for (const auto& [date, item] : *got[row]) {
            if (!item.end) {
                list.push_back(item.splat);
            }
        }
        return list;
    }
};

class SlicingByUnits : public ::testing::TestWithParam<int> {};

// n units take n splats of a row each per cycle: 3969 splats take ceil(3969 / n) cycles.
TEST_P(SlicingByUnits, TakeASplatEach) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 3969; ++i) {
        splats.push_back(one_pixel(i % 63, i / 63 % 63));
    }
    SharedSlicing slicing(splats, 64, GetParam());
    sc_core::sc_start();
    Cycle last = 0;
    std::size_t rows = 0;
    for (int row = 0; row < 64; ++row) {
        const std::vector<std::uint32_t> order = slicing.splats(row);
        EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
        rows += order.size();
        for (const Cycle date : slicing.sent(row)) {
            last = std::max(last, date);
        }
    }
    const auto units = static_cast<Cycle>(GetParam());
    EXPECT_EQ(rows, 3969U);
    EXPECT_EQ(last + 1, (3969 + units - 1) / units);
    EXPECT_EQ(slicing.unit->stats().busy, 3969U);
}

INSTANTIATE_TEST_SUITE_P(Units, SlicingByUnits, ::testing::Values(1, 2, 4, 8));

// The second splat covers rows 8 to 15, which the first one sends in its second cycle.
TEST(SlicingBySplats, AYoungerSplatDoesNotOvertake) {
    SharedSlicing slicing({blanket(8, 8, 32), one_row(2, 9, 12), one_row(2, 9, 3)}, 16, 3);
    sc_core::sc_start();
    EXPECT_EQ(slicing.sent(7), (std::vector<Cycle>{0}));
    EXPECT_EQ(slicing.sent(8), (std::vector<Cycle>{1}));
    EXPECT_EQ(slicing.sent(12), (std::vector<Cycle>{1, 1}));
    EXPECT_EQ(slicing.splats(12), (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(slicing.sent(3), (std::vector<Cycle>{0, 0})); // both older splats have passed row 3
    EXPECT_EQ(slicing.unit->stats().busy, 2U + 2 + 1);
}

// Two splats of a row each in a cycle of one unit, whose rows_per_cycle they share.
TEST(SlicingBySplats, AUnitMayTakeSeveralSplatsPerCycle) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 10; ++i) {
        splats.push_back(one_pixel(i, 5));
    }
    SharedSlicing slicing(splats, 16, 1, 2);
    sc_core::sc_start();
    EXPECT_EQ(slicing.sent(5), (std::vector<Cycle>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4}));
    EXPECT_EQ(slicing.unit->stats().busy, 5U);
}

// Of two units that share the rows, each passes over the other's splats in no time, or in a cycle.
class SlicingBroadcast : public ::testing::TestWithParam<SliceDistribution> {};

TEST_P(SlicingBroadcast, PassesOverSplatsOfOtherUnits) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 12; ++i) {
        splats.push_back(one_pixel(i, i % 4 == 0 ? 1 : 2)); // every fourth splat is of unit 1
    }
    UnitBench bench(make_frame(splats, 16, 16, 16));
    GaussianSlicingUnit::Config config;
    config.distribution = GetParam();
    GaussianSlicingUnit unit("unit", config, bench.time, bench.job, 1, 1, 2, 0, 16);
    DatedFifo<SplatChunk> chunks("chunks", bench.time, 4);
    DatedFifo<TileNumber> cancel("cancel", bench.time, 4);
    DatedFifo<RowItem> rows("rows", bench.time, 256);
    unit.in[0].bind(chunks);
    unit.cancel.bind(cancel);
    unit.out[0].bind(rows);
    bench.script([&](Process& self) {
        chunks.connect_writer(self);
        self.advance(9);
        SplatChunk chunk;
        chunk.count = 12;
        chunk.last = true;
        chunks.put(self, chunk);
    });
    bench.script([&](Process& self) { cancel.connect_writer(self); });
    const auto& got = bench.drain(rows);
    sc_core::sc_start();
    ASSERT_EQ(got.size(), 3U + 1);
    const Cycle pace = GetParam() == SliceDistribution::Broadcast ? 4 : 1;
    for (Cycle i = 0; i < 3; ++i) {
        EXPECT_EQ(got[i].first, 11 + i * pace);
    }
    EXPECT_EQ(unit.stats().busy, pace == 1 ? 3U : 12U);
    EXPECT_EQ(unit.stats().splats, 12U);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SlicingBroadcast,
                         ::testing::Values(SliceDistribution::Broadcast,
                                           SliceDistribution::BroadcastSkip));

// A cancelled tile's chunks go by at one per cycle and send nothing but the end.
TEST(GaussianSlicingUnit, DropsWhatWasCancelled) {
    UnitBench bench(make_frame({blanket(8, 8, 32)}, 16, 16, 16));
    GaussianSlicingUnit::Config config;
    config.count = 1;
    GaussianSlicingUnit unit("unit", config, bench.time, bench.job, 0, 1, 1, 0, 16);
    DatedFifo<SplatChunk> chunks("chunks", bench.time, 8);
    DatedFifo<TileNumber> cancel("cancel", bench.time, 4, 8);
    DatedFifo<RowItem> rows("rows", bench.time, 256);
    unit.in[0].bind(chunks);
    unit.cancel.bind(cancel);
    unit.out[0].bind(rows);
    bench.script([&](Process& self) {
        chunks.connect_writer(self);
        SplatChunk chunk;
        chunk.count = 1;
        self.advance(26);
        chunks.put(self, chunk); // read at 27: not cancelled yet
        chunk.last = true;
        self.advance(1);
        chunks.put(self, chunk); // read at 28 at the earliest: cancelled
    });
    bench.script([&](Process& self) {
        cancel.connect_writer(self);
        self.advance(20);
        cancel.put(self, 0); // known at 28
    });
    const auto& got = bench.drain(rows);
    sc_core::sc_start();
    EXPECT_EQ(got.size(), 16U + 1);
    EXPECT_EQ(unit.stats().splats, 1U);
    EXPECT_EQ(unit.stats().splats_cancelled, 1U);
}

} // namespace
} // namespace degs
