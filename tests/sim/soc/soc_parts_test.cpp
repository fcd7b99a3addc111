// SPDX-License-Identifier: Apache-2.0
// Display and cores of the platform at a memory that always takes as long, and the words about it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tlm_utils/simple_target_socket.h>

#include "sim/soc/cpu_traffic.hpp"
#include "sim/soc/display.hpp"
#include "sim/soc/soc_study.hpp"

namespace degs::sim {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

/// Answers everything after the same time, and counts it.
struct SteadyMemory : sc_core::sc_module {
    tlm_utils::simple_target_socket<SteadyMemory> in{"in"};
    sc_core::sc_time latency;
    int reads = 0, writes = 0;
    SteadyMemory(const sc_core::sc_module_name& name, double ns)
        : sc_core::sc_module(name), latency(ns, sc_core::SC_NS) {
        in.register_b_transport(this, &SteadyMemory::take);
    }
    void take(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
        ++(payload.is_write() ? writes : reads);
        delay += latency;
        payload.set_response_status(tlm::TLM_OK_RESPONSE);
    }
};

/// Rows of 16 B every 250 ns.
Display::Config small_screen() {
    Display::Config screen;
    screen.refresh_hz = 1e6;
    return screen;
}

TEST(Display, ARowIsLateWhenTheNextOneIsDue) {
    SteadyMemory quick("quick", 240), slow("slow", 260);
    Display in_time("in_time", small_screen()), late("late", small_screen());
    in_time.out.bind(quick.in);
    late.out.bind(slow.in);
    in_time.show({{0, 4, 4}});
    late.show({{0, 4, 4}});
    sc_core::sc_start(sc_core::sc_time(9900, sc_core::SC_NS));
    EXPECT_EQ(in_time.stats().rows, 40U);
    EXPECT_EQ(in_time.stats().underruns, 0U);
    EXPECT_EQ(late.stats().underruns, 40U);
    EXPECT_EQ(late.stats().bytes, 40U * 16);
}

// A picture of 4 + 1 rows in a microsecond: each row has a fifth of it, whatever view it is of.
TEST(Display, ShowsAllViewsOfAFrame) {
    SteadyMemory memory("memory", 190);
    Display display("display", small_screen());
    display.out.bind(memory.in);
    display.show({{0, 4, 4}, {64, 8, 1}});
    sc_core::sc_start(sc_core::sc_time(9900, sc_core::SC_NS));
    EXPECT_EQ(display.stats().rows, 50U);
    EXPECT_EQ(display.stats().bytes, 10U * (4 * 16 + 32));
    EXPECT_EQ(display.stats().underruns, 0U);
}

TEST(CpuTraffic, WritesALineForSoManyReads) {
    SteadyMemory memory("memory", 0);
    CpuTraffic::Config config;
    config.reads_per_write = 3;
    CpuTraffic core("core", config);
    core.out.bind(memory.in);
    core.set_rate(64); // a line in each ns
    sc_core::sc_start(sc_core::sc_time(10, sc_core::SC_US));
    EXPECT_NEAR(memory.reads + memory.writes, 10000, 2);
    EXPECT_NEAR(memory.writes, 2500, 220); // five standard deviations
}

std::vector<SocPoint> rising_latency() {
    std::vector<SocPoint> points(3);
    for (std::size_t p = 0; p < points.size(); ++p) {
        points[p].cpu_gb_per_s = 100.0 * static_cast<double>(p);
        points[p].frames.resize(1);
        points[p].frames[0].latency_ns = 1e6 * static_cast<double>(1U << p); // 1, 2 and 4 ms
    }
    return points;
}

TEST(SocWords, FramesAreSlowerThanTheFirst) {
    SocResult result;
    result.points = rising_latency();
    const std::string words = soc_words({}, {}, result);
    for (const char* row : {" 1.00 +1.00x\n", " 2.00 +2.00x\n", " 4.00 +4.00x\n"}) {
        EXPECT_THAT(words, ContainsRegex(row));
    }
}

TEST(SocPlot, AxesHaveTheirOwnNumbers) {
    const std::string svg = soc_svg("T", rising_latency());
    for (const char* tick : {">200<", ">250<", ">4<", ">5<"}) { // GB/s by 50, ms by 1
        EXPECT_THAT(svg, HasSubstr(tick));
    }
}

} // namespace
} // namespace degs::sim
