// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/saturation.hpp"

#include <gtest/gtest.h>

#include "tests/modules/degs/workload_fixture.hpp"

namespace degs {
namespace {

/// Ten splats of ordinary size and `huge` ones of 1e6 px around a mean at x.
FrameWorkload frame_with(int huge, double x = 8) {
    std::vector<ProjectedSplat> splats(10, test::blanket(8, 8, 16));
    for (int i = 0; i < huge; ++i) {
        splats.push_back(test::make_splat(x, 8, 1e6, 1e6, 0, 0.5));
    }
    return test::make_frame(splats, 16, 16, 16);
}

TEST(Saturation, OrdinarySplatsStayInRange) {
    for (const char* name : {"fp32", "fp64", "ideal", "fp16", "paper", "tuned"}) {
        EXPECT_TRUE(saturated_stages(named_numbers(name), frame_with(0)).empty()) << name;
    }
}

// r_x = 1e6 px x sqrt(Q_th) lies beyond 131 008 px; the mean lies where the formats end.
TEST(Saturation, NamesStageFormatLimitAndSplats) {
    const auto found = saturated_stages(named_numbers("tuned"), frame_with(3));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].stage, "radius");
    EXPECT_EQ(found[0].format, "ue5m15b14");
    EXPECT_EQ(found[0].limit, parse_format("ue5m15b14").max());
    EXPECT_EQ(found[0].splats, 3U);
}

TEST(Saturation, CountsMeansBeyondTheirFormat) {
    const auto found = saturated_stages(named_numbers("tuned"), frame_with(2, 2e5));
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].stage, "mean");
    EXPECT_EQ(found[0].splats, 2U);
    EXPECT_EQ(found[1].stage, "radius");
}

TEST(Saturation, SinglePrecisionReachesFarEnough) {
    EXPECT_TRUE(saturated_stages(named_numbers("fp32"), frame_with(3, 2e5)).empty());
    EXPECT_FALSE(saturated_stages(named_numbers("fp32", {"radius=fp16"}), frame_with(3)).empty());
}

// A splat of the least opacity covers its mean's row alone: 1 / r_y^2 is beyond every format, and
// nothing is lost.
TEST(Saturation, LeavesOutRowsThatOneRowSays) {
    const FrameWorkload frame =
        test::make_frame({test::make_splat(8, 8, 1, 1, 0, 1.0000001 / 255)}, 16, 16, 16);
    ASSERT_EQ(frame.splats.size(), 1U);
    EXPECT_TRUE(saturated_stages(named_numbers("tuned"), frame).empty());
}

// A splat once, whichever of its channels the format does not reach.
TEST(Saturation, CountsColoursOfEveryChannel) {
    FrameWorkload frame = frame_with(0);
    for (int channel = 0; channel < 3; ++channel) {
        frame.splats[channel].colour[channel] = 1e6;
    }
    frame.splats[3].colour[0] = frame.splats[3].colour[2] = 1e6;
    const auto found = saturated_stages(named_numbers("fp32", {"colour=fp16"}), frame);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].stage, "colour");
    EXPECT_EQ(found[0].splats, 4U);
}

} // namespace
} // namespace degs
