// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/array/feature_buffer.hpp"

#include <gtest/gtest.h>

namespace degs {
namespace {

TEST(FeatureBuffer, OneEntryForAllRowsOfASplat) {
    FeatureBuffer buffer(2);
    ASSERT_TRUE(buffer.admit(0, 7, 1));
    const std::uint16_t entry = buffer.current();
    buffer.hold(entry);
    ASSERT_TRUE(buffer.admit(0, 7, 5));
    EXPECT_EQ(buffer.current(), entry);
    ASSERT_TRUE(buffer.admit(1, 7, 6)); // a splat in another tile is another entry
    EXPECT_NE(buffer.current(), entry);
    EXPECT_EQ(buffer.stats().waits, 0U);
}

// Needed until the write-back of the last task: not free at t - 1, free at t.
TEST(FeatureBuffer, AnEntryIsFreeFromTheDateOfItsLastTask) {
    FeatureBuffer buffer(1);
    ASSERT_TRUE(buffer.admit(0, 1, 0));
    const std::uint16_t entry = buffer.current();
    buffer.hold(entry);
    buffer.hold(entry);
    buffer.release(entry, 30);           // later than the next one
    EXPECT_FALSE(buffer.admit(0, 2, 3)); // the splat is closed, one task is still to come
    EXPECT_EQ(buffer.next_free(), kNever);
    buffer.release(entry, 20);
    EXPECT_EQ(buffer.next_free(), 30U);
    EXPECT_FALSE(buffer.admit(0, 2, 29));
    EXPECT_TRUE(buffer.admit(0, 2, 30));
    EXPECT_EQ(buffer.next_free(), kNever);
    EXPECT_EQ(buffer.stats().waits, 1U); // one wait, asked twice
}

TEST(FeatureBuffer, ASplatWithoutTasksLeavesAtOnce) {
    FeatureBuffer buffer(1);
    ASSERT_TRUE(buffer.admit(0, 1, 5));
    EXPECT_TRUE(buffer.admit(0, 2, 5));
    buffer.close(6);
    EXPECT_EQ(buffer.next_free(), 6U);
    EXPECT_TRUE(buffer.admit(0, 3, 6));
}

// All rows of the splat may have executed before its last row comes in.
TEST(FeatureBuffer, AnOpenSplatKeepsItsEntry) {
    FeatureBuffer buffer(1);
    ASSERT_TRUE(buffer.admit(0, 1, 0));
    const std::uint16_t entry = buffer.current();
    buffer.hold(entry);
    buffer.release(entry, 8);
    EXPECT_EQ(buffer.next_free(), kNever);
    EXPECT_TRUE(buffer.admit(0, 1, 9));
    EXPECT_EQ(buffer.current(), entry);
    buffer.close(12);
    EXPECT_EQ(buffer.next_free(), 12U); // not before it was closed
}

// Rows of three splats in turn keep one entry each; the fourth splat closes the first one.
TEST(FeatureBuffer, SplatsWhoseRowsComeInTurnKeepTheirEntries) {
    FeatureBuffer buffer(4, 3);
    std::vector<std::uint16_t> entries;
    for (std::uint32_t splat = 0; splat < 3; ++splat) {
        ASSERT_TRUE(buffer.admit(0, splat, splat));
        entries.push_back(buffer.current());
    }
    for (std::uint32_t splat = 0; splat < 3; ++splat) {
        ASSERT_TRUE(buffer.admit(0, splat, 5));
        EXPECT_EQ(buffer.current(), entries[splat]);
    }
    ASSERT_TRUE(buffer.admit(0, 3, 9)); // the fourth entry; splat 0 gives its own back
    EXPECT_EQ(buffer.next_free(), 9U);
    ASSERT_TRUE(buffer.admit(0, 1, 10));
    EXPECT_EQ(buffer.current(), entries[1]);
    EXPECT_EQ(buffer.stats().waits, 0U);
}

// With fewer entries than splats in turn, the oldest one makes room, and nothing locks up.
TEST(FeatureBuffer, OneEntryServesSplatsInTurn) {
    FeatureBuffer buffer(1, 8);
    for (std::uint32_t splat = 0; splat < 20; ++splat) {
        EXPECT_TRUE(buffer.admit(0, splat % 3, splat));
    }
}

TEST(FeatureBuffer, HoldsAsManySplatsAsItHasEntries) {
    FeatureBuffer buffer(5);
    std::vector<std::uint16_t> entries;
    for (std::uint32_t splat = 0; splat < 5; ++splat) {
        ASSERT_TRUE(buffer.admit(0, splat, 0));
        entries.push_back(buffer.current());
        buffer.hold(entries.back());
    }
    EXPECT_FALSE(buffer.admit(0, 5, 1));
    buffer.release(entries[2], 4);
    EXPECT_TRUE(buffer.admit(0, 5, 4));
    EXPECT_EQ(buffer.current(), entries[2]);
}

// Writing an entry takes four cycles. Splats that enter together wait for each other where they
// need the same port: two ports, or two SRAM banks, or none to wait for.
class FeatureFill : public ::testing::TestWithParam<std::tuple<int, int, Cycle>> {};

TEST_P(FeatureFill, TakesAPort) {
    const auto [ports, sram_banks, second] = GetParam();
    FeatureBuffer::Fill fill;
    fill.cycles = 4;
    fill.ports.ports = ports;
    fill.ports.sram_banks = sram_banks;
    FeatureBuffer buffer(8, 2, 1, fill);
    ASSERT_TRUE(buffer.admit(0, 1, 10));
    EXPECT_FALSE(buffer.filled_by(13));
    EXPECT_TRUE(buffer.filled_by(14));
    ASSERT_TRUE(buffer.admit(0, 2, 10));
    EXPECT_FALSE(buffer.filled_by(second - 1));
    EXPECT_TRUE(buffer.filled_by(second));
    EXPECT_EQ(buffer.stats().fill_waits, 2U);
    ASSERT_TRUE(buffer.admit(0, 1, 30)); // more rows of the first need no writing
    EXPECT_TRUE(buffer.filled_by(30));
}

INSTANTIATE_TEST_SUITE_P(Ports, FeatureFill,
                         ::testing::Values(std::tuple(0, 1, 14), std::tuple(1, 1, 18),
                                           std::tuple(2, 1, 14), std::tuple(1, 2, 14)));

} // namespace
} // namespace degs
