// SPDX-License-Identifier: Apache-2.0
// All kernels are there for the same instruction sets, of which the widest is chosen.
#include <gtest/gtest.h>

#include "splat/pixels/quantized_lanes.hpp"
#include "splat/pixels/row_lanes.hpp"

namespace degs {
namespace {

template <class Function>
void expect_widest(const std::vector<Function>& variants, Function chosen) {
    EXPECT_EQ(variants.size(), round_variants().size());
    EXPECT_EQ(chosen, variants.back());
    for (std::size_t i = 1; i < variants.size(); ++i) {
        EXPECT_NE(variants[i], variants[i - 1]);
    }
}

TEST(InstructionSets, AreThoseOfEveryKernel) {
    expect_widest(blend_variants(), blend_function(0.0F));
    expect_widest(test_variants(), test_function(0.0F));
    expect_widest(product_variants(), product_function(0.0F));
    expect_widest(rasterise_variants(), rasterise_function());
    expect_widest(solve_rows_variants(), solve_rows_function());
    for (const LaneFamily family : {LaneFamily::Any, LaneFamily::Fixed, LaneFamily::Half}) {
        expect_widest(quantized_blend_variants(family), quantized_blend_function(family));
        expect_widest(quantized_test_variants(family), quantized_test_function(family));
    }
}

#if defined(__x86_64__)
TEST(InstructionSets, AreMoreThanTheLeastWhereTheMachineHasAvx2) {
    const bool wide = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
                      __builtin_cpu_supports("bmi2") != 0 && __builtin_cpu_supports("aes") != 0;
    EXPECT_EQ(round_variants().size() > 1, wide);
}
#endif

} // namespace
} // namespace degs
