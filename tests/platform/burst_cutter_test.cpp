// SPDX-License-Identifier: Apache-2.0
// Accesses in naturally aligned powers of two.
#include <random>

#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {
namespace {

std::vector<AccessPiece> cut(std::uint64_t address, unsigned int bytes, std::uint64_t burst) {
    tlm::tlm_generic_payload payload;
    payload.set_address(address);
    payload.set_data_length(bytes);
    return cut_into_bursts(payload, burst);
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

TEST(BurstCutter, BurstsOfOtherSizesAreRefused) {
    MemoryGateway::Options options;
    for (const std::uint64_t burst : {1, 2, 3, 48, 65}) {
        options.burst_bytes = burst;
        EXPECT_THROW(MemoryGateway("gateway", options), std::invalid_argument) << burst;
    }
}

} // namespace
} // namespace degs::test
