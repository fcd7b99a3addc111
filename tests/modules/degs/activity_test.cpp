// SPDX-License-Identifier: Apache-2.0
// What each block of DeGS has done for a given work, and how much its buffers hold, by hand.
#include "tests/modules/degs/run_fixture.hpp"

namespace degs {
namespace {

double operations_of(const std::vector<cost::Activity>& activity, const std::string& block) {
    for (const cost::Activity& each : activity) {
        if (each.block == block) {
            return each.operations;
        }
    }
    ADD_FAILURE() << "there is no " << block;
    return 0;
}

// A segment is written and read, or written and dropped; a packet is written and read.
TEST(DegsActivity, FollowsTheWork) {
    DegsConfig config;
    config.span.cycles_per_row = 3;
    DegsWork work;
    work.slicing_cycles = 5;
    work.issue_cycles = 6;
    work.splats_fetched = 7;
    work.splats_sliced = 11;
    work.keys_moved = 13;
    work.rows_sent = 17;
    work.rows = 19;
    work.features = 23;
    work.segments_issued = 29;
    work.segments_dropped = 31;
    work.packets = 37;
    work.slots = 41;
    const auto activity = config.activity(work);
    const auto of = [&](const char* block) { return operations_of(activity, block); };
    EXPECT_EQ(of("slicing"), 5);
    EXPECT_EQ(of("span"), 19 * 3);
    EXPECT_EQ(of("packing"), 6);
    EXPECT_EQ(of("blending"), 41);
    EXPECT_EQ(of("gaussian_buffer"), (7 + 11) * 32 + 13 * 8);
    EXPECT_EQ(of("feature_buffer"), (29 + 23) * config.feature_buffer.entry_bytes);
    EXPECT_EQ(of("span_buffer"), (17 + 19) * config.span_buffer.row_bytes);
    EXPECT_EQ(of("packing_buffer"),
              (2 * 29 + 31) * config.scheduler.segment_bytes + 2 * 37 * config.packet_bytes());
}

// As many rows as its bytes hold, and no more.
TEST(DegsBuffers, TheSpanBufferHoldsItsBytes) {
    const FrameWorkload frame = test::make_frame({test::blanket(16, 16, 32)}, 32, 32, 32);
    for (const int bytes : {4096, 8192}) {
        DegsConfig config;
        config.span_buffer.bytes = bytes;
        const test::DegsRun run("degs" + std::to_string(bytes), config, {&frame});
        const std::uint64_t rows = run.degs().span_buffer().depth;
        EXPECT_EQ(rows * config.span_buffer.row_bytes, static_cast<std::uint64_t>(bytes));
    }
}

} // namespace
} // namespace degs
