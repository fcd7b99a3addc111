// SPDX-License-Identifier: Apache-2.0
#include "tlm/memory_port.hpp"

#include <numeric>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tlm_utils/simple_target_socket.h>

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
        const Cycle done = bench.port.read(bench.self, 0, 64).date();
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

// A bus has no addresses that matter: 3 records of 64 B cost what 192 B cost. Contents are those of
// the records, and the next access is an ordinary one.
TEST(MemoryPort, MovesScatteredRecordsInOneRequest) {
    PortBench bench;
    std::vector<unsigned char> data(1024);
    for (std::size_t i = 0; i < data.size(); ++i) {
        data[i] = static_cast<unsigned char>(i / 64);
    }
    const std::vector<std::uint32_t> numbers{12, 3, 7};
    ScatteredRecords records;
    records.base = 4096;
    records.stride = records.bytes = records.burst = 64;
    records.numbers = numbers.data();
    records.count = numbers.size();
    std::vector<std::pair<std::uint64_t, int>> seen; // address and first byte of a run
    bench.port.observe_reads(
        [&](std::uint64_t address, const unsigned char* bytes, std::uint64_t count) {
            EXPECT_EQ(count, 64U);
            EXPECT_EQ(bytes[0], bytes[63]);
            seen.emplace_back(address, bytes[0]);
        });
    const Script script("script", [&] {
        bench.port.write(bench.self, 4096, data);
        bench.self.advance(500);
        EXPECT_EQ(bench.port.read(bench.self, records), 500U + 100 + 3);
        bench.self.advance(500);
        EXPECT_EQ(bench.port.read(bench.self, 4096 + 128, 64), 1000U + 100 + 1);
        EXPECT_EQ(bench.port.write(bench.self, 4096, records), 1000U + 100 + 4);
    });
    sc_core::sc_start();
    EXPECT_EQ(seen, (std::vector<std::pair<std::uint64_t, int>>{
                        {4096 + 768, 12}, {4096 + 192, 3}, {4096 + 448, 7}, {4096 + 128, 2}}));
    EXPECT_EQ(bench.memory.total().reads, 2U);
    EXPECT_EQ(bench.memory.total().bytes_read, 256U);
    EXPECT_EQ(bench.memory.total().bytes_written, 1024U + 192);
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

/// Keeps what a port announces.
struct Announced : RequestListener {
    std::vector<MemoryRequest> requests;
    void initiator(const std::string& /*name*/) override {}
    void request(const MemoryRequest& request) override { requests.push_back(request); }
};

TEST(MemoryPort, TellsOfEveryRunAsItLeaves) {
    PortBench bench;
    Announced announced;
    bench.port.tell(announced, 7);
    const std::vector<std::uint32_t> numbers{9, 1};
    const Script script("script", [&] {
        bench.self.advance(30);
        bench.port.write(bench.self, 0x140, 200);
        EXPECT_EQ(announced.requests.size(), 1U) << "before the answer is awaited";
        bench.self.advance(5);
        ScatteredRecords records;
        records.base = 4096;
        records.stride = records.bytes = 24;
        records.burst = 32;
        records.numbers = numbers.data();
        records.count = numbers.size();
        bench.port.read(bench.self, records);
        bench.port.read(bench.self, 0, 0);
    });
    sc_core::sc_start();
    ASSERT_EQ(announced.requests.size(), 3U);
    const std::vector<MemoryRequest> expected{
        {30, 0x140, 200, 7, true}, {35, 4096 + 192, 64, 7, false}, {35, 4096, 64, 7, false}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const MemoryRequest& told = announced.requests[i];
        EXPECT_EQ(told.date, expected[i].date);
        EXPECT_EQ(told.address, expected[i].address);
        EXPECT_EQ(told.bytes, expected[i].bytes);
        EXPECT_EQ(told.initiator, expected[i].initiator);
        EXPECT_EQ(told.write, expected[i].write);
    }
}

// A process may wake late; its requests leave in the cycle of the kernel.
TEST(MemoryPort, TellsOfNoRequestBeforeThePresentCycle) {
    PortBench bench;
    Announced announced;
    bench.port.tell(announced, 0);
    const Script script("script", [&] {
        sc_core::wait(sc_core::sc_time(50.5, sc_core::SC_NS));
        bench.port.write(bench.self, 0, 64);
    });
    sc_core::sc_start();
    ASSERT_EQ(announced.requests.size(), 1U);
    EXPECT_EQ(announced.requests.front().date, 50U);
}

/// A memory that remembers which accesses are urgent.
struct UrgencyTarget : sc_core::sc_module {
    tlm_utils::simple_target_socket<UrgencyTarget> in{"in"};
    std::vector<bool> urgent;
    explicit UrgencyTarget(const sc_core::sc_module_name& name) : sc_core::sc_module(name) {
        in.register_b_transport(this, &UrgencyTarget::transport);
    }
    void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& /*delay*/) {
        urgent.push_back(payload.get_extension<Urgent>() != nullptr);
        payload.set_response_status(tlm::TLM_OK_RESPONSE);
    }
};

TEST(MemoryPort, OnlyItsReadsAreUrgent) {
    const Timebase time;
    UrgencyTarget memory("memory");
    MemoryPort port("port", time);
    port.out.bind(memory.in);
    port.make_urgent();
    Process self(time);
    const Script script("script", [&] {
        port.read(self, 0, 64);
        port.write(self, 0, 64);
        port.write(self, 0, std::vector<unsigned char>(64));
        port.read(self, 0, 64);
    });
    sc_core::sc_start();
    EXPECT_EQ(memory.urgent, (std::vector<bool>{true, false, false, true}));
}

} // namespace
} // namespace degs
