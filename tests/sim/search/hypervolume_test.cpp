// SPDX-License-Identifier: Apache-2.0
#include "sim/search/hypervolume.hpp"

#include <gtest/gtest.h>

namespace degs::sim_test {
namespace {

using namespace degs::sim;

TEST(Hypervolume, IsWhatThePointsBeat) {
    EXPECT_DOUBLE_EQ(hypervolume({}, {1, 1}), 0);
    EXPECT_DOUBLE_EQ(hypervolume({{1, 3}, {2, 1}, {2, 2}}, {4, 4}), 3 + 6 - 2);
    EXPECT_DOUBLE_EQ(hypervolume({{0, 0, 0}, {5, -9, 0}}, {1, 2, 3}), 6); // the second is too bad
    // Two boxes of 2 x 2 x 1 that share 1 x 1 x 1, and one of 1 x 1 x 2 that shares 1 with both.
    EXPECT_DOUBLE_EQ(hypervolume({{0, 1, 2}, {1, 0, 2}, {1, 1, 1}}, {2, 3, 3}), 4 + 3 - 2 + 4 - 2);
    EXPECT_DOUBLE_EQ(hypervolume_gain({{1, 3}, {2, 2}}, {2, 1}, {4, 4}), 2);
    EXPECT_DOUBLE_EQ(hypervolume_gain({{1, 1}}, {2, 1}, {4, 4}), 0);
}

} // namespace
} // namespace degs::sim_test
