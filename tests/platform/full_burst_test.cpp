// SPDX-License-Identifier: Apache-2.0
// Transactions of one size, whatever the access.
#include "platform/full_burst.hpp"

#include <random>

#include <tlm_utils/simple_target_socket.h>

#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {
namespace {

constexpr unsigned int kBurst = 64;

TEST(FullBursts, CoverEveryAccessOnce) {
    std::mt19937 random(4);
    for (int i = 0; i < 2000; ++i) {
        tlm::tlm_generic_payload payload;
        payload.set_address(random() % 1000);
        payload.set_data_length(static_cast<unsigned int>(1 + random() % 700));
        const unsigned int burst = 4U << random() % 8;
        AcceleratorOptions::Memory options;
        options.burst_bytes = burst;
        options.burst_ends = BurstEnds::FullBursts;
        options.boundary_bytes = std::uint64_t{burst} << random() % 3;
        std::uint64_t next = payload.get_address();
        for (const AccessPiece& piece : cut_into_bursts(payload, options)) {
            EXPECT_EQ(piece.address, next);
            EXPECT_EQ(piece.offset, next - payload.get_address());
            EXPECT_EQ((piece.address - piece.lead) % burst, 0U);
            EXPECT_EQ(piece.length(), burst);
            EXPECT_GT(piece.bytes, 0U);
            next += piece.bytes;
        }
        EXPECT_EQ(next, payload.get_address() + payload.get_data_length());
    }
}

TEST(FullBursts, EnableTheBytesOfAWriteAndKeepThoseOfARead) {
    const AccessPiece piece{69, 2, 3, 5, 0};
    std::vector<unsigned char> data{1, 2, 3, 4, 5, 6};
    const std::vector<unsigned char> given = data;
    tlm::tlm_generic_payload payload;
    FullBurst burst;
    payload.set_command(tlm::TLM_WRITE_COMMAND);
    burst.open(payload, piece, data.data());
    EXPECT_EQ(payload.get_address(), 64U);
    ASSERT_EQ(payload.get_data_length(), 8U);
    EXPECT_EQ(payload.get_streaming_width(), 8U);
    ASSERT_EQ(payload.get_byte_enable_length(), 8U);
    for (unsigned int i = 0; i < 8; ++i) {
        const bool moved = i >= 5;
        EXPECT_EQ(payload.get_byte_enable_ptr()[i], moved ? 0xFF : 0) << i;
    }
    EXPECT_EQ(payload.get_data_ptr()[5], 3);
    EXPECT_EQ(payload.get_data_ptr()[7], 5);
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
    burst.close(payload);
    EXPECT_EQ(payload.get_byte_enable_ptr(), nullptr);
    EXPECT_EQ(data, given);

    payload.set_command(tlm::TLM_READ_COMMAND);
    for (const tlm::tlm_response_status status :
         {tlm::TLM_ADDRESS_ERROR_RESPONSE, tlm::TLM_OK_RESPONSE}) {
        burst.open(payload, piece, data.data());
        EXPECT_EQ(payload.get_byte_enable_ptr(), nullptr);
        std::fill_n(payload.get_data_ptr(), 8, 9);
        payload.set_response_status(status);
        burst.close(payload);
    }
    EXPECT_EQ(data, (std::vector<unsigned char>{1, 2, 9, 9, 9, 6}));
}

TEST(FullBursts, NeedABurst) {
    MemoryGateway::Options options;
    options.burst_ends = BurstEnds::FullBursts;
    EXPECT_THROW(MemoryGateway("gateway", options), std::invalid_argument);
}

/// All bytes but those of the workspace, which mean nothing to AT (TimingOnly).
std::vector<unsigned char> kept(const PlainMemory& memory) {
    std::vector<unsigned char> bytes = memory.bytes;
    std::fill_n(bytes.begin() + kWorkspace, kWorkspaceBytes, 0);
    return bytes;
}

// A frame with LT and AT: every access of the bus is a whole burst, and memory holds what it holds
// with smaller transactions, beside the frame and the lists, too. With a latency and no bandwidth
// LT takes the same time.
TEST(SmallRunFullBursts, LeaveTheMemoryOfSmallerTransactions) {
    const GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();
    camera.width = 93; // rows of tiles end inside of bursts
    const DegsConfig config;
    std::vector<std::unique_ptr<Platform>> platforms;
    std::vector<std::uint64_t> ragged(3), cycles(3);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::string name = "platform" + std::to_string(i);
        Accelerator::Options options;
        options.memory.burst_bytes = kBurst;
        options.memory.burst_ends = i == 0 ? BurstEnds::Pieces : BurstEnds::FullBursts;
        options.memory.transport = i == 2 ? Transport::At : Transport::Lt;
        platforms.push_back(std::make_unique<Platform>(
            name.c_str(), config, cloud,
            std::make_unique<PlainMemory>((name + "_memory").c_str(), kMemoryBytes,
                                          Timing::Annotated),
            options));
        platforms[i]->memory->on_range = [&ragged, i](std::uint64_t address, std::uint64_t bytes) {
            ragged[i] += address % kBurst != 0 || bytes != kBurst ? 1 : 0;
        };
        platforms[i]->host.script = [&, i](Host& host) {
            program(host, cloud, camera);
            EXPECT_TRUE(host.render());
            cycles[i] = host.read_pair(Register::Cycles);
        };
    }
    sc_core::sc_start();
    EXPECT_GT(ragged[0], 100U);
    EXPECT_EQ(ragged[1], 0U);
    EXPECT_EQ(ragged[2], 0U);
    EXPECT_EQ(cycles[1], cycles[0]);
    for (const auto& platform : platforms) {
        EXPECT_TRUE(platform->host.finished);
        EXPECT_EQ(platform->memory->refused, 0U);
        EXPECT_TRUE(kept(*platform->memory) == kept(*platforms[0]->memory));
    }
    EXPECT_TRUE(platforms[1]->memory->bytes == platforms[0]->memory->bytes);
    EXPECT_LT(platforms[1]->memory->accesses, platforms[0]->memory->accesses);
}

} // namespace
} // namespace degs::test
