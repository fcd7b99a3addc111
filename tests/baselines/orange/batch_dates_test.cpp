// SPDX-License-Identifier: Apache-2.0
// The core of an estimate against dates worked out by hand.
#include "baselines/orange/batch_dates.hpp"

#include <gtest/gtest.h>

namespace degs::orange {
namespace {

// A splat takes the array two cycles and blending 1.25; 256 of them take 9 for their coefficients.
Config core_without_fill() {
    Config config;
    config.fetching.chunk = 256;
    config.cores.array.fill = Fill::None;
    return config;
}

BatchDates::Tile tile_of(const Config& config, std::size_t entries, std::size_t blended) {
    return BatchDates(config).tile(entries, blended);
}

TEST(BatchDates, TheSlowerUnitPacesEqualBatches) {
    const Config config = core_without_fill();
    EXPECT_EQ(tile_of(config, 100, 1).cycles, 200);
    EXPECT_EQ(tile_of(config, 512, 2).cycles, 1024);
}

// Two products wait for a unit of a fourth of the lanes, which blends both, 1280 cycles each,
// before it forms coefficients again, for 34, and waits for their product.
TEST(BatchDates, ASlowVectorUnitEmptiesTheCore) {
    Config config = core_without_fill();
    config.cores.vector.lanes = 128;
    EXPECT_EQ(tile_of(config, 256, 1).cycles, (2 * 1280 + 34 + 512) / 2.0);
}

// While a batch of 256 is blended for 320 cycles, the array multiplies the other 44 for 88. Then
// the product of these comes first: 55 cycles, or one if the tile has ended. 9 cycles later the
// array begins with the next 256, for 512.
TEST(BatchDates, UnequalBatchesWaitForEachOther) {
    const Config config = core_without_fill();
    EXPECT_EQ(tile_of(config, 300, 1).cycles, 320 + 1 + 9 + 512);
    EXPECT_EQ(tile_of(config, 300, 2).cycles, 320 + 55 + 9 + 512);
}

// The batch behind the last one that is needed has been formed by then, the others are left out.
TEST(BatchDates, ProductsForNothing) {
    const Config config = core_without_fill();
    EXPECT_EQ(tile_of(config, 1024, 4).formed, 1024);
    EXPECT_EQ(tile_of(config, 1024, 1).formed, 512);
    EXPECT_EQ(tile_of(config, 300, 1).formed, 300);
}

TEST(BatchDates, ATileHasAtLeastASplatAndNoMoreBatchesThanItsList) {
    const Config config = core_without_fill();
    EXPECT_EQ(tile_of(config, 0, 0).formed, 1);
    EXPECT_EQ(tile_of(config, 100, 7).cycles, tile_of(config, 100, 1).cycles);
}

} // namespace
} // namespace degs::orange
