// SPDX-License-Identifier: Apache-2.0
// The parts of degs memory without a simulation: traffic, traces and derived numbers.
#include <gtest/gtest.h>

#include "degs/lpddr5.hpp"
#include "sim/memory/memory_pattern.hpp"
#include "sim/memory/memory_report.hpp"
#include "sim/memory/memory_traffic.hpp"
#include "sim/memory/trace_reader.hpp"
#include "stats/statistics_document.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using namespace degs::sim;

// 8 nJ for 1000 B in 4 ns.
TEST(MemoryReport, EnergyIsPerBitAndPowerPerSecond) {
    MemoryFacts facts;
    facts.saturated.energy.activate_nj = 8;
    facts.saturated.bytes = 1000;
    facts.saturated.seconds = 4e-9;
    const auto written = memory_json(facts);
    EXPECT_DOUBLE_EQ(written["energy"]["pj_per_bit"].get<double>(), 1);
    EXPECT_DOUBLE_EQ(written["energy"]["mean_power_w"].get<double>(), 2);
    EXPECT_DOUBLE_EQ(written["bandwidth_gb_per_s"].get<double>(), 250);
}

// Platforms read by name what memory.json reports, but for what only a measurement has.
TEST(MemoryReport, HasTheNamesOfTheMemoryOfPlatforms) {
    degs::Lpddr5 memory("memory", "", 1);
    std::size_t found = 0;
    for (const Statistic& row :
         document_statistics([](StatsVisitor& visitor) { describe(MemoryFacts(), visitor); })) {
        const std::string section = row.path.substr(0, row.path.find('.'));
        if (row.section || section == "traffic" || section == "curve" || section == "host") {
            continue;
        }
        EXPECT_NO_THROW(memory.statistic(row.path)) << row.path;
        ++found;
    }
    EXPECT_GT(found, 40U);
}

TEST(TraceReader, CutsRequestsWhereLinesEnd) {
    const Folder folder;
    std::ofstream(folder / "t.stl") << "7: (100) write 0x30\n";
    TraceReader reader(folder / "t.stl", 1000);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> parts;
    for (TraceAccess access; reader.next(access);) {
        parts.emplace_back(access.address, access.bytes);
        EXPECT_EQ(access.cycle, 7U);
    }
    const std::vector<std::pair<std::uint64_t, std::uint64_t>> expected{
        {0x30, 16}, {0x40, 64}, {0x80, 20}};
    EXPECT_EQ(parts, expected);
}

TEST(TrafficDealer, WritesAsOftenAsItIsTold) {
    const dram::Config memory;
    TrafficShape shape;
    shape.reads_per_write = 3;
    const dram::Channels channels(memory);
    TrafficDealer dealer(shape, channels.mapping(), 1);
    int writes = 0;
    for (int i = 0; i < 10000; ++i) {
        writes += dealer.draw().write ? 1 : 0;
    }
    EXPECT_NEAR(writes, 2500, 200); // five standard deviations
}

// A request takes places of the queue for every line of 64 B that it begins.
TEST(TrafficWindow, CountsWholeLines) {
    const dram::Config memory;
    EXPECT_EQ(traffic_window(memory, 65), traffic_window(memory, 128));
    EXPECT_EQ(traffic_window(memory, 129), traffic_window(memory, 192));
    EXPECT_GT(traffic_window(memory, 64), traffic_window(memory, 65));
}

// What was on its way when the warm-up ended has met a memory that was not full yet, so its latency
// does not count.
TEST(TrafficWindow, LeavesOutLatenciesOfTheWarmUp) {
    const dram::Config config;
    dram::Lpddr5 memory("memory", config, Timebase(), config.channels);
    MemoryTraffic traffic("traffic", memory, config, {});
    const TrafficResult result = traffic.measure(2000, 0);
    const std::uint64_t on_their_way = config.channels * traffic_window(config, 64);
    EXPECT_GE(result.requests, 2000U);
    EXPECT_LT(result.reads.samples(), result.requests - on_their_way / 2);
    EXPECT_GE(result.reads.samples(), result.requests - on_their_way);
}

} // namespace
} // namespace degs::sim_test
