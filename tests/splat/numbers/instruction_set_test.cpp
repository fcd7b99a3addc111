// SPDX-License-Identifier: Apache-2.0
#include "splat/numbers/instruction_set.hpp"

#include <gtest/gtest.h>

#include "splat/pixels/quantized_lanes.hpp"

namespace degs {
namespace {

TEST(InstructionSets, KeepWhatTheMachineCanRun) {
    const std::size_t most = static_cast<std::size_t>(instruction_set()) + 1;
    EXPECT_EQ(runnable<int>({4, 8, 16}).size(), most);
    EXPECT_EQ(runnable<int>({4, 8, 16}).front(), 4);
    EXPECT_EQ(runnable<int>({4, 8}).size(), std::min<std::size_t>(most, 2));
    EXPECT_EQ(runnable<int>({4}).size(), 1U);
}

// All kernels are chosen alike, each among those that it has.
TEST(InstructionSets, AreThoseOfEveryKernel) {
    const std::size_t most = static_cast<std::size_t>(instruction_set()) + 1;
    EXPECT_EQ(blend_variants().size(), std::min<std::size_t>(most, 2));
    EXPECT_EQ(test_variants().size(), blend_variants().size());
    EXPECT_EQ(round_variants().size(), blend_variants().size());
    for (const LaneFamily family : {LaneFamily::Any, LaneFamily::Fixed, LaneFamily::Half}) {
        EXPECT_EQ(quantized_blend_variants(family).size(), most);
        EXPECT_EQ(quantized_test_variants(family).size(), most);
        EXPECT_EQ(quantized_blend_function(family), quantized_blend_variants(family).back());
    }
}

} // namespace
} // namespace degs
