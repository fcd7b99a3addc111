// SPDX-License-Identifier: Apache-2.0
// Number formats and memories that a run does not use are neither built nor run.
#include "dram/lpddr5.hpp"
#include "tests/modules/degs/workload_fixture.hpp"
#include "tests/sim/needed_work/counted_run.hpp"
#include "tests/tlm/memory_fixture.hpp"

namespace degs::sim_test {
namespace {

int tables_of(const std::string& design, const std::string& numbers) {
    const sim::RunConfig config = shipped(design, {"pipeline.numbers=" + numbers});
    const FrameWorkload frame =
        test::random_frame(5, 64, 64, config.accelerator().tile_size_px(), 20);
    return counted_run(config, frame)["lookup_tables"].get<int>();
}

class UnusedFormats : public testing::TestWithParam<const char*> {};

TEST_P(UnusedFormats, FillNoLookupTable) {
    EXPECT_EQ(LookupTable::filled(), 0U);
    EXPECT_EQ(tables_of(GetParam(), "fp32"), 0);
    EXPECT_EQ(tables_of(GetParam(), "fp64"), 0);
    EXPECT_GT(tables_of(GetParam(), "paper"), 0); // so that the count can be wrong
}
INSTANTIATE_TEST_SUITE_P(Designs, UnusedFormats,
                         testing::Values("degs-64", "gscore-64", "gbu-64", "gcc-64"));

const char* const kLpddr5 = "memory.model=lpddr5";

// An array alone has unlimited memory, whatever its configuration says, so it must not build DRAM.
TEST(UnusedMemory, OfAnArrayAloneDoesNothing) {
    const FrameWorkload frame = test::random_frame(5, 128, 96, 32, 50);
    BuildOptions array;
    array.array_only = true;
    const Counts with = counted_run(shipped("degs-64", {kLpddr5}), frame, array);
    EXPECT_EQ(with, counted_run(shipped("degs-64"), frame, array));
    EXPECT_TRUE(with["dram_commands"].is_null());
    // The design with its memory, so that the comparison can fail.
    const Counts used = counted_run(shipped("degs-64", {kLpddr5}), frame);
    EXPECT_FALSE(used["dram_commands"].is_null());
    EXPECT_GT(used["activations"], with["activations"]);
}

/// LPDDR5 with two initiators, and what the kernel and its channels did.
struct IdleDram {
    dram::Config config;
    std::uint64_t activations = 0;
    Timebase time{ClockDomain(1.0), Fidelity::Exact, nullptr, &activations};
    dram::Lpddr5 memory{"memory", config, time, 2};
    test::Initiator first{"first"}, second{"second"};
    std::vector<std::uint64_t> commands = std::vector<std::uint64_t>(config.channels, 0);

    IdleDram() {
        first.out.bind(memory.in[0]);
        second.out.bind(memory.in[1]);
        memory.observe([this](unsigned channel, const dram::Issued&) { ++commands[channel]; });
    }
};

TEST(UnusedMemory, LeavesTheKernelNothingToDo) {
    IdleDram idle;
    sc_core::sc_start();
    EXPECT_EQ(idle.activations, 0U);
    EXPECT_EQ(sc_core::sc_time_stamp(), sc_core::SC_ZERO_TIME);
    EXPECT_FALSE(sc_core::sc_pending_activity());
    // Refreshes are worked out when somebody asks for them, not while time passes.
    sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_MS));
    EXPECT_EQ(idle.activations, 0U);
    EXPECT_EQ(idle.commands, std::vector<std::uint64_t>(idle.config.channels, 0));
    const auto counted = idle.memory.commands().commands;
    EXPECT_GT(counted[static_cast<std::size_t>(dram::Command::RefAb)], 0U);
    EXPECT_EQ(counted[static_cast<std::size_t>(dram::Command::Act1)], 0U);
}

} // namespace
} // namespace degs::sim_test
