// SPDX-License-Identifier: Apache-2.0
// What an access does: granules, contents, errors.
#include "tlm/memory.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include "tests/tlm/memory_fixture.hpp"

namespace degs {
namespace {

using sc_core::sc_time;
using sc_core::sc_time_stamp;
using test::Initiator;
using test::memory_config;
using test::MemoryBench;
using test::Script;

TEST(Memory, PartialAccessesCostWholeGranules) {
    MemoryBench bench(memory_config(0), 1);
    const Script script("script", [&] {
        unsigned char data[256];
        const struct {
            std::uint64_t address;
            unsigned int bytes;
            std::uint64_t granules;
        } cases[] = {{0, 1, 1}, {63, 1, 1}, {63, 2, 2}, {0, 64, 1}, {1, 64, 2}, {32, 200, 4}};
        std::uint64_t bytes = 0;
        for (const auto& c : cases) {
            sc_core::wait(sc_time(100, sc_core::SC_NS));
            const sc_time start = sc_time_stamp();
            const auto answer = bench[0].access(tlm::TLM_READ_COMMAND, c.address, data, c.bytes);
            EXPECT_EQ(answer.done - start,
                      sc_time(static_cast<double>(c.granules), sc_core::SC_NS));
            bytes += 64 * c.granules;
            EXPECT_EQ(bench.memory.stats(0).bytes_read, bytes);
        }
    });
    sc_core::sc_start();
    EXPECT_EQ(bench.memory.stats(0).reads, 6U);
}

TEST(Memory, WhatWasWrittenIsReadBack) {
    MemoryBench bench(memory_config(), 2);
    std::mt19937 random(3);
    std::vector<unsigned char> model(20000, 0);
    constexpr std::uint64_t kBase = 0xABCDEF000; // far apart pages must not meet
    const Script script("script", [&] {
        for (int i = 0; i < 400; ++i) {
            const auto bytes = 1 + static_cast<unsigned int>(random() % 9000); // up to three pages
            const std::size_t at = random() % (model.size() - bytes);
            std::vector<unsigned char> data(bytes);
            std::generate(data.begin(), data.end(),
                          [&] { return static_cast<unsigned char>(random()); });
            const auto begin = model.begin() + static_cast<std::ptrdiff_t>(at);
            switch (random() % 4) {
            case 0:
                bench[0].access(tlm::TLM_WRITE_COMMAND, kBase + at, data.data(), bytes);
                std::copy(data.begin(), data.end(), begin);
                break;
            case 1:
                EXPECT_EQ(bench[1].debug(tlm::TLM_WRITE_COMMAND, kBase + at, data.data(), bytes),
                          bytes);
                std::copy(data.begin(), data.end(), begin);
                break;
            case 2:
                bench[1].access(tlm::TLM_READ_COMMAND, kBase + at, data.data(), bytes);
                EXPECT_TRUE(std::equal(data.begin(), data.end(), begin));
                break;
            default:
                EXPECT_EQ(bench[0].debug(tlm::TLM_READ_COMMAND, kBase + at, data.data(), bytes),
                          bytes);
                EXPECT_TRUE(std::equal(data.begin(), data.end(), begin));
            }
        }
    });
    sc_core::sc_start();
}

// The debug interface costs no time and counts as no traffic.
TEST(Memory, DebugAccessesTakeNoTime) {
    MemoryBench bench(memory_config(), 1);
    const Script script("script", [&] {
        unsigned char data[64] = {1};
        bench[0].debug(tlm::TLM_WRITE_COMMAND, 0, data, 64);
        EXPECT_EQ(sc_time_stamp(), sc_core::SC_ZERO_TIME);
    });
    sc_core::sc_start();
    EXPECT_EQ(bench.memory.total().writes, 0U);
}

TEST(Memory, TimingOnlyAccessesTakeTheirTimeAndKeepNothing) {
    MemoryBench bench(memory_config(), 1);
    const Script script("script", [&] {
        unsigned char data[64];
        TimingOnly mark;
        std::fill_n(data, 64, static_cast<unsigned char>(0x5A));
        const auto write =
            bench[0].access(tlm::TLM_WRITE_COMMAND, 0, data, 64, sc_core::SC_ZERO_TIME, &mark);
        EXPECT_EQ(write.done, sc_time(101, sc_core::SC_NS));
        const auto read =
            bench[0].access(tlm::TLM_READ_COMMAND, 0, data, 64, sc_core::SC_ZERO_TIME, &mark);
        EXPECT_EQ(read.status, tlm::TLM_OK_RESPONSE);
        EXPECT_EQ(data[0], 0x5A); // neither written to memory nor overwritten
        bench[0].debug(tlm::TLM_READ_COMMAND, 0, data, 64);
        EXPECT_EQ(std::accumulate(data, data + 64, 0), 0);
    });
    sc_core::sc_start();
    EXPECT_EQ(bench.memory.total().bytes_written, 64U);
    EXPECT_EQ(bench.memory.total().bytes_read, 64U);
}

// What the memory cannot do is a TLM response, not an exception, and costs nothing.
TEST(Memory, HostileRequestsAreErrorResponses) {
    MemoryBench bench(memory_config(), 1);
    const Script script("script", [&] {
        unsigned char data[64] = {};
        unsigned char enables[64] = {};
        tlm::tlm_generic_payload payload;
        sc_time delay(5, sc_core::SC_NS);
        const auto status = [&] {
            bench[0].out->b_transport(payload, delay);
            EXPECT_TRUE(payload.is_response_error());
            return payload.get_response_status();
        };
        Initiator::fill(payload, tlm::TLM_IGNORE_COMMAND, 0, data, 64);
        EXPECT_EQ(status(), tlm::TLM_COMMAND_ERROR_RESPONSE);
        Initiator::fill(payload, tlm::TLM_READ_COMMAND, 0, data, 0);
        EXPECT_EQ(status(), tlm::TLM_BURST_ERROR_RESPONSE);
        Initiator::fill(payload, tlm::TLM_WRITE_COMMAND, 0, data, 64);
        payload.set_streaming_width(32);
        EXPECT_EQ(status(), tlm::TLM_BURST_ERROR_RESPONSE);
        Initiator::fill(payload, tlm::TLM_WRITE_COMMAND, 0, data, 64);
        payload.set_byte_enable_ptr(enables);
        payload.set_byte_enable_length(64);
        EXPECT_EQ(status(), tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
        EXPECT_EQ(delay, sc_time(5, sc_core::SC_NS));
        EXPECT_EQ(sc_time_stamp(), sc_core::SC_ZERO_TIME);
        EXPECT_EQ(bench[0].debug(tlm::TLM_IGNORE_COMMAND, 0, data, 64), 0U);
    });
    sc_core::sc_start();
    EXPECT_EQ(bench.memory.total().reads + bench.memory.total().writes, 0U);
}

} // namespace
} // namespace degs
