// SPDX-License-Identifier: Apache-2.0
// What the registers of degs::Accelerator count, against the slots of a closed run, and which bits
// they keep.
#include "modules/degs/config.hpp"
#include "tests/baselines/engine_run.hpp"
#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {
namespace {

struct CountedFrame {
    explicit CountedFrame(const DegsConfig& config) {
        const GaussianCloud cloud = test_cloud();
        const Camera camera = test_camera();
        Platform platform("accelerator", config, cloud);
        const FrameWorkload work =
            make_frame_workload(cloud, camera, config.tile_size_px(), config.tile_mode());
        const EngineRun closed("closed", config, {&work});
        platform.host.script = [&](Host& host) {
            program(host, cloud, camera);
            EXPECT_TRUE(host.render());
            fragments = host.read_pair(Register::Fragments);
        };
        sc_core::sc_start();
        EXPECT_TRUE(platform.host.finished);
        slots = closed.result().slots;
    }
    std::uint64_t fragments = 0;
    SlotAccount slots;
};

TEST(SmallRunCounters, FragmentsAreUsefulSlotsWithExactSpanEnds) {
    DegsConfig config;
    config.pipeline.span_ends = SpanEnds::Exact;
    const CountedFrame frame(config);
    EXPECT_GT(frame.fragments, 1000U);
    EXPECT_EQ(frame.fragments, frame.slots[Slot::Useful]);
}

// A pixel outside the ellipse is updated as well, unless it has ended.
TEST(SmallRunCounters, FragmentsAreMoreThanUsefulSlotsWithOutwardSpanEnds) {
    DegsConfig config;
    ASSERT_EQ(config.pipeline.span_ends, SpanEnds::Outward);
    const CountedFrame frame(config);
    EXPECT_GT(frame.fragments, frame.slots[Slot::Useful]);
    EXPECT_LE(frame.fragments, frame.slots[Slot::Useful] + frame.slots[Slot::Boundary]);
}

TEST(SmallRunCounters, RegistersOfBitsKeepNoReservedBit) {
    Platform platform("accelerator", DegsConfig(), test_cloud());
    platform.host.script = [&](Host& host) {
        host.write(Register::IrqEnable, ~0U);
        EXPECT_EQ(host.read(Register::IrqEnable), kIrqDone | kIrqError | kIrqAborted | kIrqFault);
        std::uint32_t word = ~0U;
        tlm::tlm_generic_payload payload;
        payload.set_write();
        payload.set_address(AcceleratorRegisters::offset_of(Register::IrqEnable));
        payload.set_data_ptr(reinterpret_cast<unsigned char*>(&word));
        payload.set_data_length(4);
        EXPECT_EQ(host.out->transport_dbg(payload), 4U);
        EXPECT_EQ(host.read(Register::IrqEnable), kIrqDone | kIrqError | kIrqAborted | kIrqFault);
    };
    sc_core::sc_start();
    EXPECT_TRUE(platform.host.finished);
}

} // namespace
} // namespace degs::test
