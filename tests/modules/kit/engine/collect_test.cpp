// SPDX-License-Identifier: Apache-2.0
// What is counted when a run has ended, by hand.
#include "modules/kit/engine/collect.hpp"

#include "tests/modules/kit/job/unit_bench.hpp"

namespace degs {
namespace {

// Each task reads the state of its pixel, each fragment writes it, and 16 x 13 pixels of two tiles
// are read out.
TEST(PixelActivity, TasksFragmentsAndReadout) {
    const test::UnitBench bench(test::make_frame({test::blanket(16, 8, 64)}, 32, 13, 16));
    AcceleratorResult result;
    result.slots[Slot::Useful] = 100;
    result.slots[Slot::Boundary] = 30;
    result.slots[Slot::Terminated] = 20;
    result.slots[Slot::Starved] = 1000;
    add_pixel_activity(result, bench.job, 16);
    ASSERT_EQ(result.activity.size(), 1U);
    EXPECT_EQ(result.activity[0].block, "pixel_buffer");
    EXPECT_EQ(result.activity[0].operations, 16.0 * (150 + 100 + 2 * 16 * 13));
}

// The first of two images is background alone, whose write takes 100 ns; splats cover the second,
// so that nothing of it has to be written and its background is done before.
TEST(FrameDates, ImagesLeaveInOrder) {
    test::UnitBench bench(test::make_frame({}, 16, 16, 16));
    const FrameWorkload covered = test::make_frame({test::blanket(8, 8, 64)}, 16, 16, 16);
    bench.job = make_render_job({&bench.frame, &covered},
                                {Arithmetic::Fp64, SpanEnds::Exact, 0, StopRule::Refuse, {}}, 1);
    BackgroundWriter unit("unit", {}, bench.time, bench.job, 1, false, false);
    DatedFifo<std::uint32_t> listed("listed", bench.time, 1);
    unit.listed[0].bind(listed);
    bench.connect({&unit.frame_buffer}, 100);
    bench.script([&](Process& self) {
        listed.connect_writer(self);
        listed.put(self, 0);
        listed.put(self, 1);
    });
    sc_core::sc_start();
    ASSERT_EQ(unit.frames_written().size(), 2U);
    ASSERT_LT(unit.frames_written()[1], 100U);
    AcceleratorResult result;
    collect_frames(result, bench.job, {}, unit);
    ASSERT_EQ(result.frames.size(), 2U);
    EXPECT_GE(result.frames[0].finished, 100U);
    EXPECT_EQ(result.frames[1].finished, result.frames[0].finished);
    EXPECT_EQ(result.cycles, result.frames[0].finished);
}

// Three arrays of four PEs: one works from 10 to 19, one from 15 to 29, and one not at all.
TEST(ArraySlots, WaitForTheWindowOfAll) {
    AcceleratorResult result;
    ActiveWindow first, second, third;
    first.include({10, 19});
    second.include({15, 29});
    SlotAccount busy;
    busy[Slot::Useful] = 40;
    add_slots(result, busy, first);
    busy[Slot::Useful] = 60;
    add_slots(result, busy, second);
    add_slots(result, {}, third);
    for (const ActiveWindow& window : {first, second, third}) {
        close_slots(result, window, 4);
    }
    EXPECT_EQ(result.slots[Slot::Useful], 100U);
    EXPECT_EQ(result.slots[Slot::Starved], 5U * 4);
    EXPECT_EQ(result.slots[Slot::Drain], (10U + 20) * 4);
    EXPECT_EQ(result.slots.total(), 3U * 4 * 20);
}

} // namespace
} // namespace degs
