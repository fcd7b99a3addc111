// SPDX-License-Identifier: Apache-2.0
#include "base/median.hpp"

#include <gtest/gtest.h>

namespace degs {
namespace {

TEST(Median, IsInTheMiddle) {
    EXPECT_FALSE(median_of({}));
    EXPECT_EQ(median_of({7}), 7);
    EXPECT_EQ(median_of({9, 1, 2}), 2);
    EXPECT_EQ(median_of({8, 1, 4, 2}), 3);
}

} // namespace
} // namespace degs
