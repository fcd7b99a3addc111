// SPDX-License-Identifier: Apache-2.0
#include "sim/search/rank_correlation.hpp"

#include <gtest/gtest.h>

namespace degs::sim_test {
namespace {

using namespace degs::sim;

TEST(RankCorrelation, IsSpearmans) {
    EXPECT_DOUBLE_EQ(*rank_correlation({1, 2, 30}, {5, 6, 7}), 1.0);
    EXPECT_DOUBLE_EQ(*rank_correlation({1, 2, 3}, {3, 2, 1}), -1.0);
    // Ranks 1 2 3 4 against 2 1 4 3: 1 - 6 * 4 / (4 * 15) = 0.6.
    EXPECT_NEAR(*rank_correlation({1, 2, 3, 4}, {20, 10, 40, 30}), 0.6, 1e-12);
    EXPECT_FALSE(rank_correlation({1, 2}, {1, 2}));
    EXPECT_FALSE(rank_correlation({1, 1, 1}, {1, 2, 3}));
}

} // namespace
} // namespace degs::sim_test
