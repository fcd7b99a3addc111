// SPDX-License-Identifier: Apache-2.0
// Rounding of float arrays, once per instruction set.
#include <cstring>

#include "splat/numbers/number_format.hpp"

#if defined(__x86_64__)
#define DEGS_HAS_WIDE_LANES 1
#endif

namespace degs {
namespace narrow_rounding {
#include "splat/numbers/rounding.inc"
using Value = float __attribute__((vector_size(16)));
using Bits = std::int32_t __attribute__((vector_size(16)));
void round_array(const LaneRounding& to, float* values, std::size_t count) {
    round_vectors<Value, Bits>(to, values, count);
}
} // namespace narrow_rounding

#ifdef DEGS_HAS_WIDE_LANES
#pragma GCC push_options
#pragma GCC target("avx2")
namespace wide_rounding {
#include "splat/numbers/rounding.inc" // NOLINT(readability-duplicate-include): once per instruction set
using Value = float __attribute__((vector_size(32)));
using Bits = std::int32_t __attribute__((vector_size(32)));
void round_array(const LaneRounding& to, float* values, std::size_t count) {
    round_vectors<Value, Bits>(to, values, count);
}
} // namespace wide_rounding
#pragma GCC pop_options
#endif

std::vector<RoundFunction> round_variants() {
    std::vector<RoundFunction> variants{&narrow_rounding::round_array};
#ifdef DEGS_HAS_WIDE_LANES
    if (__builtin_cpu_supports("avx2") != 0) {
        variants.push_back(&wide_rounding::round_array);
    }
#endif
    return variants;
}

RoundFunction round_function() {
    static const RoundFunction widest = round_variants().back();
    return widest;
}

} // namespace degs
