// SPDX-License-Identifier: Apache-2.0
// Rounding of float arrays, once per instruction set.
#include <cstring>

#include "splat/numbers/instruction_set.hpp"
#include "splat/numbers/number_format.hpp"

#ifdef DEGS_HAS_WIDE_LANES
#include <immintrin.h>
#endif

namespace degs {
namespace narrow_rounding {
constexpr int kLanes = 4;
#include "splat/numbers/rounding.inc"
} // namespace narrow_rounding

#ifdef DEGS_HAS_WIDE_LANES
#pragma GCC push_options
#pragma GCC target("avx2")
namespace wide_rounding {
constexpr int kLanes = 8;
#include "splat/numbers/rounding.inc" // NOLINT(readability-duplicate-include)
} // namespace wide_rounding
#pragma GCC pop_options
#else
namespace wide_rounding = narrow_rounding;
#endif

std::vector<RoundFunction> round_variants() {
    return runnable<RoundFunction>({&narrow_rounding::round_array, &wide_rounding::round_array});
}

} // namespace degs
