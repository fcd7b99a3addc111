// SPDX-License-Identifier: Apache-2.0
// Several frames in one run, and the array alone: order, dates and images.
#include "tests/modules/degs/run_fixture.hpp"

namespace degs {
namespace {

using test::DegsRun;
using test::exact_arithmetic;
using test::random_frame;

DegsConfig frames_config(int in_flight) {
    DegsConfig config = exact_arithmetic();
    config.frames_in_flight = in_flight;
    return config;
}

std::vector<FrameWorkload> three_frames() {
    std::vector<FrameWorkload> frames;
    for (unsigned seed : {1U, 2U, 3U}) {
        frames.push_back(random_frame(seed, 80, 64, 32, 300));
    }
    return frames;
}

std::vector<const FrameWorkload*> pointers(const std::vector<FrameWorkload>& frames) {
    std::vector<const FrameWorkload*> list;
    for (const FrameWorkload& frame : frames) {
        list.push_back(&frame);
    }
    return list;
}

AcceleratorResult result_of(const DegsRun& run) {
    AcceleratorResult result;
    result.clock_ghz = run.degs().config().clock_ghz;
    run.degs().collect(result);
    return result;
}

class Frames : public ::testing::TestWithParam<int> {};

TEST_P(Frames, PaintTheReferenceAndStrictAgrees) {
    const std::vector<FrameWorkload> frames = three_frames();
    const DegsRun exact("exact", frames_config(GetParam()), pointers(frames));
    const DegsRun strict("strict", frames_config(GetParam()), pointers(frames), Fidelity::Strict);
    sc_core::sc_start();
    test::expect_sound(exact);
    test::expect_reference(exact);
    test::expect_same_statistics(exact, strict);
    const AcceleratorResult result = result_of(exact);
    ASSERT_EQ(result.frames.size(), 3U);
    EXPECT_EQ(result.frames.back().finished, result.cycles);
    for (std::size_t f = 1; f < 3; ++f) {
        EXPECT_GT(result.frames[f].finished, result.frames[f - 1].finished);
        const bool waited = result.frames[f].preprocessed > result.frames[f - 1].finished;
        EXPECT_EQ(waited, GetParam() == 1) << f;
    }
}
INSTANTIATE_TEST_SUITE_P(InFlight, Frames, ::testing::Values(1, 2, 3));

// The next frame's preprocessing keeps the only channel busy, and the frame that is blended waits.
TEST(Frames, BlendingMayReadFirst) {
    std::vector<FrameWorkload> frames;
    for (unsigned seed : {1U, 2U, 3U, 4U}) {
        frames.push_back(random_frame(seed, 80, 64, 32, 3000));
    }
    DegsConfig config = frames_config(2);
    config.memory.model = MemoryModel::Lpddr5;
    config.memory.lpddr5.channels = 1;
    const DegsRun age("age", config, pointers(frames));
    config.memory.priority = ReadPriority::Blending;
    const DegsRun exact("exact", config, pointers(frames));
    const DegsRun strict("strict", config, pointers(frames), Fidelity::Strict);
    sc_core::sc_start();
    test::expect_sound(exact);
    test::expect_reference(exact);
    test::expect_same_statistics(exact, strict);
    const AcceleratorResult before = result_of(age);
    const AcceleratorResult result = result_of(exact);
    // Nothing comes before the first frame; while it is blended, the second is preprocessed.
    EXPECT_LT(result.frames[0].finished, before.frames[0].finished);
    EXPECT_GT(result.frames[1].preprocessed, before.frames[1].preprocessed);
}

// A frame without any splat in view has no tile that could end it.
TEST(Frames, EmptyOnesDoNotStopTheOthers) {
    std::vector<FrameWorkload> frames = three_frames();
    frames[1] = test::make_frame({}, 80, 64, 32);
    frames[2] = test::make_frame({}, 80, 64, 32);
    frames.push_back(random_frame(4, 80, 64, 32, 50));
    const DegsRun run("run", frames_config(1), pointers(frames));
    sc_core::sc_start();
    test::expect_sound(run);
    test::expect_reference(run);
    EXPECT_EQ(result_of(run).frames.size(), 4U);
}

TEST(ArrayOnly, PaintsTheSameImageSoonerAndStrictAgrees) {
    const std::vector<FrameWorkload> frames = three_frames();
    const DegsRun whole("whole", frames_config(2), pointers(frames));
    const DegsRun exact("exact", frames_config(2), pointers(frames), Fidelity::Exact, {true});
    const DegsRun strict("strict", frames_config(2), pointers(frames), Fidelity::Strict, {true});
    sc_core::sc_start();
    test::expect_sound(exact);
    test::expect_reference(exact);
    test::expect_same_statistics(exact, strict);
    EXPECT_LT(exact.degs().finished(), whole.degs().finished());
    EXPECT_LE(exact.window().first, 40U); // no projection, no sorting, no memory before the array
}

} // namespace
} // namespace degs
