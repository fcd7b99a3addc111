// SPDX-License-Identifier: Apache-2.0
#include "tlm/memory_port.hpp"

#include <numeric>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tlm/script.hpp"

namespace degs {
namespace {

using test::Script;

/// One port at one memory of 64 GB/s and 100 ns.
struct PortBench {
    Timebase time;
    Memory memory;
    MemoryPort port;
    Process self;
    explicit PortBench(double gigahertz = 1.0)
        : time{ClockDomain(gigahertz), Fidelity::Exact}, memory("memory", config(), time, 1),
          port("port", time), self(time) {
        port.out.bind(memory.in[0]);
    }
    static Memory::Config config() {
        Memory::Config c;
        c.bandwidth_gb_per_s = 64;
        c.latency_ns = 100;
        return c;
    }
};

TEST(MemoryPort, ReturnsTheCompletionAndLeavesTheDate) {
    PortBench bench;
    const Script script("script", [&] {
        bench.self.advance(30);
        EXPECT_EQ(bench.port.read(bench.self, 0, 128), 30U + 100 + 2);
        EXPECT_EQ(bench.self.local(), 30U);
        bench.self.advance(10);
        EXPECT_EQ(bench.port.write(bench.self, 0, 64), 40U + 100 + 1);
        EXPECT_EQ(bench.self.local(), 40U);
    });
    sc_core::sc_start();
    EXPECT_EQ(bench.memory.total().bytes_read, 128U);
    EXPECT_EQ(bench.memory.total().bytes_written, 64U);
}

// The answer is the first whole cycle at or after the transfer's end.
TEST(MemoryPort, RoundsUpToCyclesOfItsClock) {
    PortBench bench(0.7); // 1429 ps
    const Script script("script", [&] {
        bench.self.advance(7);
        const Cycle done = bench.port.read(bench.self, 0, 64);
        EXPECT_EQ(done, (7U * 1429 + 101000 + 1428) / 1429);
    });
    sc_core::sc_start();
    EXPECT_EQ(bench.memory.total().reads, 1U);
}

TEST(MemoryPort, NothingCostsNothing) {
    PortBench bench;
    const Script script("script", [&] {
        bench.self.advance(3);
        EXPECT_EQ(bench.port.read(bench.self, 0, 0), 3U);
        EXPECT_EQ(bench.port.write(bench.self, 0, std::vector<unsigned char>{}), 3U);
    });
    sc_core::sc_start();
    EXPECT_EQ(bench.memory.total().reads + bench.memory.total().writes, 0U);
}

TEST(MemoryPort, WritesRealBytesOrOnlyTheirTime) {
    PortBench bench;
    std::vector<unsigned char> data(100);
    std::iota(data.begin(), data.end(), static_cast<unsigned char>(1));
    std::vector<unsigned char> back(100);
    const Script script("script", [&] {
        bench.port.write(bench.self, 1000, data);
        bench.self.advance(500);
        bench.port.write(bench.self, 1000, 100); // values are not kept: nothing changes
        tlm::tlm_generic_payload payload;
        payload.set_read();
        payload.set_address(1000);
        payload.set_data_ptr(back.data());
        payload.set_data_length(100);
        bench.port.out->transport_dbg(payload);
    });
    sc_core::sc_start();
    EXPECT_EQ(back, data);
    EXPECT_EQ(bench.memory.total().writes, 2U);
}

/// A target that refuses everything.
struct Refusal : sc_core::sc_module {
    tlm_utils::simple_target_socket<Refusal> in;
    explicit Refusal(const sc_core::sc_module_name& name) : sc_core::sc_module(name), in("in") {
        in.register_b_transport(this, &Refusal::transport);
    }
    void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& /*delay*/) {
        payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
    }
};

TEST(MemoryPort, AnErrorResponseThrowsWhoWhatAndWhere) {
    const Timebase time;
    Refusal refusal("refusal");
    MemoryPort port("port", time);
    port.out.bind(refusal.in);
    Process self(time);
    std::string message;
    const Script script("script", [&] {
        try {
            port.read(self, 4711, 64);
        } catch (const std::runtime_error& error) {
            message = error.what();
        }
    });
    sc_core::sc_start();
    EXPECT_THAT(message, ::testing::HasSubstr("port"));
    EXPECT_THAT(message, ::testing::HasSubstr("TLM_ADDRESS_ERROR_RESPONSE"));
    EXPECT_THAT(message, ::testing::HasSubstr("64 bytes"));
    EXPECT_THAT(message, ::testing::HasSubstr("4711"));
}

} // namespace
} // namespace degs
