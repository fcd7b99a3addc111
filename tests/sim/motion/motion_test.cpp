// SPDX-License-Identifier: Apache-2.0
#include "sim/motion/motion.hpp"

#include <gtest/gtest.h>

#include "sim/motion/motion_output.hpp"

namespace degs::sim {
namespace {

Motion motion_of(const std::vector<double>& ms, double pose_hz, std::vector<double> rates) {
    Motion motion;
    motion.rates_hz = std::move(rates);
    motion.designs.push_back({"a", {}});
    for (std::size_t k = 0; k < ms.size(); ++k) {
        motion.times_s.push_back(static_cast<double>(k) / pose_hz);
        motion.designs[0].ms.emplace_back(ms[k]);
    }
    judge_motion(motion);
    return motion;
}

TEST(NearestRank, IsAValueThatTheShareDoesNotExceed) {
    EXPECT_EQ(nearest_rank({5}, 0.5), 5);
    EXPECT_EQ(nearest_rank({4, 1, 3, 2}, 0.5), 2);
    EXPECT_EQ(nearest_rank({4, 1, 3, 2}, 0.51), 3);
    EXPECT_EQ(nearest_rank({4, 1, 3, 2}, 1), 4);
    std::vector<double> hundred;
    for (int i = 1; i <= 100; ++i) {
        hundred.push_back(i);
    }
    EXPECT_EQ(nearest_rank(hundred, 0.95), 95);
    EXPECT_EQ(nearest_rank(hundred, 0.99), 99);
}

/// Ten poses at 100 Hz; the third and fourth take two periods and a half.
TEST(Motion, RefreshesByHand) {
    const Motion motion = motion_of({4, 4, 25, 25, 4, 4, 4, 4, 4, 4}, 100, {100});
    const DesignMotion& design = motion.designs[0];
    ASSERT_TRUE(design.ranks);
    EXPECT_EQ(design.ranks->p50, 4);
    EXPECT_EQ(design.ranks->p95, 25);
    EXPECT_EQ(design.ranks->worst_frame, 2U);
    ASSERT_EQ(design.displays.size(), 1U);
    const DisplayResult& display = design.displays[0];
    // Frame 2 takes refreshes 2 to 4, so that pose 3 is never rendered: 0, 1, 2, 5, 6, 7, 8, 9.
    EXPECT_EQ(display.refreshes, 10);
    EXPECT_EQ(display.frames, 8);
    EXPECT_EQ(display.missed, 1);
    EXPECT_EQ(display.repeated, 2);
    // Seven frames of a period and a half, and one of three and a half.
    EXPECT_NEAR(display.photon_mean_ms, (7 * 15 + 35) / 8.0, 1e-9);
    EXPECT_NEAR(display.photon_p95_ms, 35, 1e-9);
    EXPECT_NEAR(display.photon_worst_ms, 35, 1e-9);
}

/// A frame that takes exactly a period is in time, and another rate takes the newest pose.
TEST(Motion, PeriodsThatAreExact) {
    const Motion motion = motion_of({10, 10, 10, 10, 30, 30, 10, 10}, 100, {100, 50, 200});
    const std::vector<DisplayResult>& displays = motion.designs[0].displays;
    ASSERT_EQ(displays.size(), 3U);
    EXPECT_EQ(displays[0].frames, 6); // 0 to 4, then 7
    EXPECT_EQ(displays[0].missed, 1);
    EXPECT_EQ(displays[1].refreshes, 4);
    EXPECT_EQ(displays[1].missed, 1); // poses 0, 2, 4
    EXPECT_EQ(displays[1].frames, 3);
    EXPECT_EQ(displays[2].refreshes, 16);
    EXPECT_EQ(displays[2].missed, displays[2].frames); // all take at least two periods
    // Poses 0 to 3 take two refreshes each, pose 4 six, pose 7 two.
    EXPECT_EQ(displays[2].frames, 6);
    EXPECT_EQ(displays[2].repeated, 10);
}

/// Poses of 10 Hz on a display of 120 Hz: a pose is rendered twelve times, and older each time.
TEST(Motion, PosesAge) {
    const Motion motion = motion_of({1, 1, 1}, 10, {10, 120});
    const std::vector<DisplayResult>& displays = motion.designs[0].displays;
    EXPECT_NEAR(displays[0].photon_worst_ms, 150, 1e-9); // a period and a half, of a fresh pose
    EXPECT_EQ(displays[1].frames, 36);
    EXPECT_EQ(displays[1].repeated, 33);
    // Ages of 0 to 11 periods, and a period and a half on top.
    EXPECT_NEAR(displays[1].photon_mean_ms, (5.5 + 1.5) * 1e3 / 120, 1e-9);
    EXPECT_NEAR(displays[1].photon_worst_ms, (11 + 1.5) * 1e3 / 120, 1e-9);
}

/// Refreshes of 75 Hz between poses of 50 Hz: the middle one of three is two thirds of its period
/// late.
TEST(Motion, AgesOfPosesBetweenRefreshes) {
    const Motion motion = motion_of(std::vector<double>(6, 5), 50, {50, 75});
    const DisplayResult& display = motion.designs[0].displays.at(1);
    const double period = 1e3 / 75;
    // Dates 0, 13.3, 26.7 ms of poses at 0, 0, 20 ms.
    EXPECT_NEAR(display.photon_worst_ms, period * 2.5, 1e-9);
    EXPECT_NEAR(display.photon_mean_ms, (0 + period + 2 * period - 20) / 3 + 1.5 * period, 1e-9);
    EXPECT_EQ(display.frames, 9);
    EXPECT_EQ(display.repeated, 3);
}

/// A frame that takes two refreshes shows the age that its pose had when it began.
TEST(Motion, AgesOfFramesThatAreLate) {
    const Motion motion = motion_of({12, 12}, 25, {25, 100});
    const DisplayResult& display = motion.designs[0].displays.at(1);
    // Begun at 0, 20, 40, 60 ms: ages 0, 20, 0, 20 ms.
    EXPECT_EQ(display.frames, 4);
    EXPECT_EQ(display.repeated, 6);
    EXPECT_NEAR(display.photon_mean_ms, 10 + 25, 1e-9);
    EXPECT_NEAR(display.photon_worst_ms, 20 + 25, 1e-9);
}

TEST(Motion, KnowsNoDisplayIfAFrameIsMissing) {
    Motion motion = motion_of({4, 8, 4}, 100, {100});
    motion.designs[0].ms[1].reset();
    judge_motion(motion);
    EXPECT_TRUE(motion.designs[0].displays.empty());
    ASSERT_TRUE(motion.designs[0].ranks);
    EXPECT_EQ(motion.designs[0].ranks->worst, 4);
    motion.designs[0].ms.assign(3, std::nullopt);
    judge_motion(motion);
    EXPECT_FALSE(motion.designs[0].ranks);
}

// One frame in two hundred takes 100 ms, and the axis goes up to it.
TEST(MotionPicture, ShowsTheWorstFrame) {
    std::vector<double> ms(200, 4);
    ms[7] = 100;
    const std::string svg =
        motion_latency_svg({"scene", "64×48", false, {}}, motion_of(ms, 100, {100}));
    EXPECT_NE(svg.find(">100</text>"), std::string::npos);
}

TEST(Motion, OneFrame) {
    const Motion motion = motion_of({40}, 90, {90});
    const DisplayResult& display = motion.designs[0].displays.at(0);
    EXPECT_EQ(display.refreshes, 1);
    EXPECT_EQ(display.frames, 1);
    EXPECT_EQ(display.missed, 1);
    EXPECT_EQ(display.repeated, 0);
}

} // namespace
} // namespace degs::sim
