// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/job/messages.hpp"

#include <gtest/gtest.h>

namespace degs {
namespace {

TEST(Messages, ContextsAreUsedInTurn) {
    EXPECT_EQ(context_in_turn(0, 3), 0);
    EXPECT_EQ(context_in_turn(2, 3), 2);
    EXPECT_EQ(context_in_turn(3, 3), 0);
    EXPECT_EQ(context_in_turn(kNoTile - 1, 1), 0);
    EXPECT_EQ(context_in_turn(std::uint64_t{1} << 40, kMostContexts),
              (std::uint64_t{1} << 40) % kMostContexts);
    EXPECT_EQ(context_in_turn(kMostContexts - 1, kMostContexts), kMostContexts - 1);
}

TEST(Messages, TheLastChunkIsWhatIsLeft) {
    EXPECT_EQ(next_chunk_of(16, 40), 16U);
    EXPECT_EQ(next_chunk_of(16, 16), 16U);
    EXPECT_EQ(next_chunk_of(16, 5), 5U);
    EXPECT_EQ(next_chunk_of(16, 0), 0U);
    EXPECT_EQ(next_chunk_of(16, (std::uint64_t{1} << 32) + 1), 16U); // more than 32 bits hold
}

} // namespace
} // namespace degs
