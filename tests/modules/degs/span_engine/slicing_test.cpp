// SPDX-License-Identifier: Apache-2.0
// Slicing Units alone: dates against closed formulas.
#include <algorithm>

#include "modules/degs/span_engine/gaussian_slicing_unit.hpp"
#include "tests/modules/kit/job/unit_bench.hpp"

namespace degs {
namespace {

using test::blanket;
using test::make_frame;
using test::one_pixel;
using test::one_row;
using test::UnitBench;

/// Module `index` of a slicing stage with `lanes` Span Units, on one tile of `size` pixels.
struct SlicingBench {
    UnitBench bench;
    GaussianSlicingUnit unit;
    DatedFifo<SplatChunk> chunks{"chunks", bench.time, 8};
    DatedFifo<TileNumber> cancel{"cancel", bench.time, 4, 8};
    std::vector<std::unique_ptr<DatedFifo<RowItem>>> lanes;
    std::vector<std::vector<std::pair<Cycle, RowItem>>*> got;

    SlicingBench(const std::vector<ProjectedSplat>& splats, int size,
                 const GaussianSlicingUnit::Config& config, int index = 0, int span_units = 1)
        : bench(make_frame(splats, size, size, size)),
          unit("unit", config, bench.time, bench.job, index, 1, span_units, 0, 16) {
        unit.in[0].bind(chunks);
        unit.cancel.bind(cancel);
        for (auto& port : unit.out) {
            lanes.push_back(std::make_unique<DatedFifo<RowItem>>(
                ("lane" + std::to_string(lanes.size())).c_str(), bench.time, 4096));
            port.bind(*lanes.back());
            got.push_back(&bench.drain(*lanes.back()));
        }
    }
    /// All splats in one chunk, which can be read at 10; nothing is cancelled.
    void run(std::uint32_t splats) {
        bench.script([this, splats](Process& self) {
            chunks.connect_writer(self);
            self.advance(9);
            SplatChunk chunk;
            chunk.count = splats;
            chunk.last = true;
            chunks.put(self, chunk);
        });
        bench.script([this](Process& self) { cancel.connect_writer(self); });
        sc_core::sc_start();
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

GaussianSlicingUnit::Config one_unit() {
    GaussianSlicingUnit::Config config;
    config.count = 1;
    return config;
}

/// `count` units that share out the splats.
GaussianSlicingUnit::Config sharing(int count, int splats_per_cycle = 1) {
    GaussianSlicingUnit::Config config;
    config.count = count;
    config.splats_per_cycle = splats_per_cycle;
    config.distribution = SliceDistribution::Splats;
    return config;
}

class Slicing : public ::testing::TestWithParam<int> {};

// `rows_per_cycle` rows of a splat per cycle, a new splat in a new cycle.
TEST_P(Slicing, RowsPerCycle) {
    GaussianSlicingUnit::Config config = one_unit();
    config.rows_per_cycle = GetParam();
    SlicingBench slicing({blanket(8, 8, 32), one_pixel(3, 4), blanket(8, 8, 32)}, 16, config);
    slicing.run(3);
    const auto& got = *slicing.got[0];
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
    EXPECT_EQ(slicing.unit.stats().rows, 33U);
    EXPECT_EQ(slicing.unit.stats().busy, 2 * blanket_cycles + 1);
}

INSTANTIATE_TEST_SUITE_P(Rates, Slicing, ::testing::Values(1, 3, 4, 16));

class SlicingByUnits : public ::testing::TestWithParam<int> {};

// n units take n splats of a row each per cycle: 3969 splats take ceil(3969 / n) cycles.
TEST_P(SlicingByUnits, TakeASplatEach) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 3969; ++i) {
        splats.push_back(one_pixel(i % 63, i / 63 % 63));
    }
    SlicingBench slicing(splats, 64, sharing(GetParam()), 0, 64);
    slicing.run(3969);
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
    EXPECT_EQ(slicing.unit.stats().busy, 3969U);
}

INSTANTIATE_TEST_SUITE_P(Units, SlicingByUnits, ::testing::Values(1, 2, 4, 8));

// The second splat covers rows 8 to 15, which the first one sends in its second cycle.
TEST(SlicingBySplats, AYoungerSplatDoesNotOvertake) {
    SlicingBench slicing({blanket(8, 8, 32), one_row(2, 9, 12), one_row(2, 9, 3)}, 16, sharing(3),
                         0, 16);
    slicing.run(3);
    EXPECT_EQ(slicing.sent(7), (std::vector<Cycle>{0}));
    EXPECT_EQ(slicing.sent(8), (std::vector<Cycle>{1}));
    EXPECT_EQ(slicing.sent(12), (std::vector<Cycle>{1, 1}));
    EXPECT_EQ(slicing.splats(12), (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(slicing.sent(3), (std::vector<Cycle>{0, 0})); // both older splats have passed row 3
    EXPECT_EQ(slicing.unit.stats().busy, 2U + 2 + 1);
}

// Two splats of a row each in a cycle of one unit, whose rows_per_cycle they share.
TEST(SlicingBySplats, AUnitMayTakeSeveralSplatsPerCycle) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 10; ++i) {
        splats.push_back(one_pixel(i, 5));
    }
    SlicingBench slicing(splats, 16, sharing(1, 2), 0, 16);
    slicing.run(10);
    EXPECT_EQ(slicing.sent(5), (std::vector<Cycle>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4}));
    EXPECT_EQ(slicing.unit.stats().busy, 5U);
}

// Each of two units that share the rows passes over the other's splats in no time, or in a cycle,
// of which it may take several at once.
class SlicingBroadcast : public ::testing::TestWithParam<std::tuple<SliceDistribution, int, int>> {
};

TEST_P(SlicingBroadcast, PassesOverSplatsOfOtherUnits) {
    const auto& [distribution, splats_per_cycle, cycles] = GetParam();
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 12; ++i) {
        splats.push_back(one_pixel(i, i % 4 == 0 ? 1 : 2)); // every fourth splat is of unit 1
    }
    GaussianSlicingUnit::Config config;
    config.distribution = distribution;
    config.splats_per_cycle = splats_per_cycle;
    SlicingBench slicing(splats, 16, config, 1, 2);
    slicing.run(12);
    const auto& got = *slicing.got[0];
    ASSERT_EQ(got.size(), 3U + 1);
    for (std::size_t i = 0; i < 3; ++i) {
        const Cycle before = distribution == SliceDistribution::Broadcast ? 4 * i : i;
        EXPECT_EQ(got[i].first, 11 + before / splats_per_cycle);
        EXPECT_EQ(got[i].second.splat, 4 * i);
    }
    EXPECT_EQ(slicing.unit.stats().busy, cycles);
    EXPECT_EQ(slicing.unit.stats().splats, 12U);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SlicingBroadcast,
                         ::testing::Values(std::tuple(SliceDistribution::Broadcast, 1, 12),
                                           std::tuple(SliceDistribution::Broadcast, 2, 6),
                                           std::tuple(SliceDistribution::BroadcastSkip, 1, 3),
                                           std::tuple(SliceDistribution::BroadcastSkip, 2, 2),
                                           std::tuple(SliceDistribution::BroadcastSkip, 3, 1)));

// A cancelled tile's chunks go by at one per cycle and send nothing but the end.
TEST(GaussianSlicingUnit, DropsWhatWasCancelled) {
    SlicingBench slicing({blanket(8, 8, 32)}, 16, one_unit());
    slicing.bench.script([&](Process& self) {
        slicing.chunks.connect_writer(self);
        SplatChunk chunk;
        chunk.count = 1;
        self.advance(26);
        slicing.chunks.put(self, chunk); // read at 27: not cancelled yet
        chunk.last = true;
        self.advance(1);
        slicing.chunks.put(self, chunk); // read at 28 at the earliest: cancelled
    });
    slicing.bench.script([&](Process& self) {
        slicing.cancel.connect_writer(self);
        self.advance(20);
        slicing.cancel.put(self, 0); // known at 28
    });
    sc_core::sc_start();
    EXPECT_EQ(slicing.got[0]->size(), 16U + 1);
    EXPECT_EQ(slicing.unit.stats().splats, 1U);
    EXPECT_EQ(slicing.unit.stats().splats_cancelled, 1U);
}

// Four units that share out eight splats of a row each, with as many reads per cycle as there are
// ports and SRAM banks: 8 / 4, 8 / 2 and 8 / 1 cycles.
class SlicingPorts : public ::testing::TestWithParam<std::tuple<int, int, Cycle>> {};

TEST_P(SlicingPorts, LimitTheSplatsPerCycle) {
    const auto [ports, sram_banks, cycles] = GetParam();
    GaussianSlicingUnit::Config config = sharing(4);
    config.splat_ports.ports = ports;
    config.splat_ports.sram_banks = sram_banks;
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 8; ++i) {
        splats.push_back(one_pixel(i, i));
    }
    SlicingBench slicing(splats, 16, config, 0, 16);
    slicing.run(8);
    EXPECT_EQ(slicing.sent(7).back() + 1, cycles);
    EXPECT_EQ(slicing.unit.stats().splat_port_waits, cycles == 2 ? 0U : cycles - 1);
}

INSTANTIATE_TEST_SUITE_P(Ports, SlicingPorts,
                         ::testing::Values(std::tuple(0, 1, 2), std::tuple(4, 1, 2),
                                           std::tuple(2, 1, 4), std::tuple(1, 2, 4),
                                           std::tuple(1, 1, 8)));

// Four units whose splats all have row 3: they write to one lane, in order of depth.
class SlicingRowPorts : public ::testing::TestWithParam<std::pair<int, std::vector<Cycle>>> {};

TEST_P(SlicingRowPorts, LimitTheRowsPerLaneAndCycle) {
    GaussianSlicingUnit::Config config = sharing(4);
    config.row_ports.ports = GetParam().first;
    SlicingBench slicing(std::vector<ProjectedSplat>(4, one_pixel(2, 3)), 16, config, 0, 16);
    slicing.run(4);
    EXPECT_EQ(slicing.sent(3), GetParam().second);
    EXPECT_EQ(slicing.splats(3), (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

INSTANTIATE_TEST_SUITE_P(Ports, SlicingRowPorts,
                         ::testing::Values(std::pair(0, std::vector<Cycle>{0, 0, 0, 0}),
                                           std::pair(2, std::vector<Cycle>{0, 0, 1, 1}),
                                           std::pair(1, std::vector<Cycle>{0, 1, 2, 3})));

} // namespace
} // namespace degs
