// SPDX-License-Identifier: Apache-2.0
// Cycles of products worked out by hand, and the share of the multipliers that they fill.
#include <gtest/gtest.h>

#include "baselines/orange/systolic_array.hpp"
#include "splat/pixels/exponent_gemm.hpp"

namespace degs::orange {
namespace {

SystolicArray::Config array_of(int side, Fill fill = Fill::Pass) {
    SystolicArray::Config c;
    c.rows = c.columns = side;
    c.fill = fill;
    return c;
}

/// Products of numbers over multiplier-cycles.
double used(const SystolicArray::Config& c, int splats, int pixels) {
    return double(kGemmDepth) * splats * pixels / (double(c.cycles(splats, pixels)) * c.macs());
}

// A reduction of six, 256 splats, 64 pixels.
TEST(OrangeArray, CyclesOfAProductByHand) {
    // 2 x 2: 3 steps of the reduction x 32 groups of pixels, each 256 splats and 2 cycles of skew.
    EXPECT_EQ(array_of(2).cycles(256, 64), 3U * 32 * (256 + 2));
    // 4 x 4: the reduction takes 2 steps, the second of which fills half of the rows.
    EXPECT_EQ(array_of(4).cycles(256, 64), 2U * 16 * (256 + 6));
    // 32 x 32: one step, two groups of pixels.
    EXPECT_EQ(array_of(32).cycles(256, 64), 2U * (256 + 62));
    // 128 x 128: one pass; half of the columns have no pixel.
    EXPECT_EQ(array_of(128).cycles(256, 64), 256U + 254);
    EXPECT_EQ(array_of(32).cycles(0, 64), 0U);
    EXPECT_EQ(array_of(32).cycles(1, 64), 2U * 63);
}

TEST(OrangeArray, FillsOncePerProductOrNever) {
    EXPECT_EQ(array_of(32, Fill::Batch).cycles(256, 64), 2U * 256 + 62);
    EXPECT_EQ(array_of(32, Fill::None).cycles(256, 64), 2U * 256);
}

TEST(OrangeArray, LoadsMonomialsInFrontOfAPassIfItCannotBefore) {
    SystolicArray::Config c = array_of(32);
    c.preload = false;
    EXPECT_EQ(c.cycles(256, 64), 2U * (32 + 256 + 62));
}

// Rows are splats: 8 groups of them x 2 groups of pixels, each 6 cycles of reduction and the skew.
TEST(OrangeArray, KeepsSumsInsteadOfMonomials) {
    SystolicArray::Config c = array_of(32);
    c.dataflow = Dataflow::Output;
    EXPECT_EQ(c.cycles(256, 64), 8U * 2 * (6 + 62));
    EXPECT_EQ(c.cycles(257, 64), 9U * 2 * (6 + 62));
    c.fill = Fill::None;
    EXPECT_EQ(c.cycles(256, 64), 8U * 2 * 6);
    EXPECT_DOUBLE_EQ(used(c, 256, 64), 1.0);
    EXPECT_EQ(c.reduction_share(), 1.0);
}

struct ShareOfSide {
    int side;
    double reduction, used; ///< with 256 splats and as many pixels as columns
};

// K / (ceil(K / R) R), times 256 / (256 + 2 R - 2) for filling.
class OrangeArrayShare : public ::testing::TestWithParam<ShareOfSide> {};

TEST_P(OrangeArrayShare, IsThatOfTheReductionAndTheFill) {
    const ShareOfSide& expected = GetParam();
    const SystolicArray::Config c = array_of(expected.side);
    EXPECT_DOUBLE_EQ(c.reduction_share(), expected.reduction);
    EXPECT_DOUBLE_EQ(used(c, 256, c.columns), expected.used);
    EXPECT_DOUBLE_EQ(used(array_of(expected.side, Fill::None), 256, c.columns), expected.reduction);
}

INSTANTIATE_TEST_SUITE_P(Sides, OrangeArrayShare,
                         ::testing::Values(ShareOfSide{2, 1.0, 256.0 / 258},
                                           ShareOfSide{4, 0.75, 0.75 * 256 / 262},
                                           ShareOfSide{8, 0.75, 0.75 * 256 / 270},
                                           ShareOfSide{16, 0.375, 0.375 * 256 / 286},
                                           ShareOfSide{32, 0.1875, 0.1875 * 256 / 318},
                                           ShareOfSide{64, 0.09375, 0.09375 * 256 / 382},
                                           ShareOfSide{128, 0.046875, 0.046875 * 256 / 510}));

// The paper's two ends: 96.0 % with 4 multipliers is a fill of two cycles behind 48 splats,
// and 4.69 % with 16 384 is the share of the reduction alone.
TEST(OrangeArray, EndsOfThePapersSweep) {
    EXPECT_DOUBLE_EQ(used(array_of(2), 48, 64), 0.96);
    EXPECT_NEAR(100 * array_of(128).reduction_share(), 4.69, 0.005);
}

} // namespace
} // namespace degs::orange
