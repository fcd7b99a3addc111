// SPDX-License-Identifier: Apache-2.0
// Accesses in naturally aligned powers of two.
#include <random>

#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {
namespace {

std::vector<AccessPiece> cut(std::uint64_t address, unsigned int bytes, std::uint64_t burst,
                             std::uint64_t boundary = 0) {
    tlm::tlm_generic_payload payload;
    payload.set_address(address);
    payload.set_data_length(bytes);
    AcceleratorOptions::Memory options;
    options.burst_bytes = burst;
    options.boundary_bytes = boundary;
    return cut_into_bursts(payload, options);
}

TEST(BurstCutter, CutsARunIntoWholeBurstsAndSmallerEnds) {
    const std::vector<AccessPiece> pieces = cut(44, 180, 64); // to 224
    const std::vector<std::array<std::uint64_t, 3>> expected{
        {44, 0, 4}, {48, 4, 16}, {64, 20, 64}, {128, 84, 64}, {192, 148, 32}};
    ASSERT_EQ(pieces.size(), expected.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        EXPECT_EQ(pieces[i].address, expected[i][0]);
        EXPECT_EQ(pieces[i].offset, expected[i][1]);
        EXPECT_EQ(pieces[i].bytes, expected[i][2]);
    }
}

TEST(BurstCutter, NoBurstIsOnePiece) {
    const std::vector<AccessPiece> pieces = cut(44, 180, 0);
    ASSERT_EQ(pieces.size(), 1U);
    EXPECT_EQ(pieces[0].bytes, 180U);
}

TEST(BurstCutter, PiecesFollowEachOtherAndAreAlignedWhateverTheAccess) {
    std::mt19937 random(3);
    for (int i = 0; i < 2000; ++i) {
        const std::uint64_t address = random() % 1000;
        const auto bytes = static_cast<unsigned int>(1 + random() % 700);
        const std::uint64_t burst = std::uint64_t{4} << random() % 8;
        std::uint64_t next = address;
        for (const AccessPiece& piece : cut(address, bytes, burst)) {
            EXPECT_EQ(piece.address, next);
            EXPECT_EQ(piece.offset, next - address);
            EXPECT_EQ(piece.bytes & (piece.bytes - 1), 0U);
            EXPECT_EQ(piece.address % piece.bytes, 0U);
            EXPECT_LE(piece.bytes, burst);
            next += piece.bytes;
        }
        EXPECT_EQ(next, address + bytes);
    }
}

// With any size of bursts; without one a piece ends at a boundary or with its run.
TEST(BurstCutter, NoPieceCrossesABoundary) {
    std::mt19937 random(5);
    for (int i = 0; i < 2000; ++i) {
        const std::uint64_t address = random() % 100000;
        const auto bytes = static_cast<unsigned int>(1 + random() % 20000);
        const std::uint64_t burst = random() % 2 == 0 ? 0 : std::uint64_t{4} << random() % 12;
        const std::uint64_t boundary = std::uint64_t{4} << random() % 12;
        std::uint64_t next = address;
        for (const AccessPiece& piece : cut(address, bytes, burst, boundary)) {
            const std::uint64_t end = piece.address + piece.bytes;
            EXPECT_EQ(piece.address, next);
            EXPECT_EQ(piece.offset, next - address);
            EXPECT_EQ(piece.address / boundary, (end - 1) / boundary);
            EXPECT_TRUE(burst != 0 || end % boundary == 0 || end == address + bytes);
            next = end;
        }
        EXPECT_EQ(next, address + bytes);
    }
}

TEST(BurstCutter, BurstsAndBoundariesOfOtherSizesAreRefused) {
    for (const std::uint64_t wrong : {1, 2, 3, 48, 65}) {
        for (auto key :
             {&MemoryGateway::Options::burst_bytes, &MemoryGateway::Options::boundary_bytes}) {
            MemoryGateway::Options options;
            options.*key = wrong;
            EXPECT_THROW(MemoryGateway("gateway", options), std::invalid_argument) << wrong;
        }
    }
    MemoryGateway::Options options;
    options.burst_bytes = 64;
    options.burst_ends = BurstEnds::FullBursts;
    options.boundary_bytes = 32;
    EXPECT_NE(MemoryGateway::problem(options), "");
    options.boundary_bytes = 64;
    EXPECT_EQ(MemoryGateway::problem(options), "");
    options.qos = 16;
    EXPECT_NE(MemoryGateway::problem(options), "");
}

} // namespace
} // namespace degs::test
