// SPDX-License-Identifier: Apache-2.0
#include "splat/blend_lanes.hpp"

#include <cmath>

#if defined(__x86_64__)
#include <immintrin.h>
#define DEGS_HAS_WIDE_LANES 1
#endif

namespace degs {
namespace narrow {
constexpr int kLanes = 4; // SSE2 and its like; every 64-bit machine has them
#include "splat/blend_kernel.inc"
} // namespace narrow

#ifdef DEGS_HAS_WIDE_LANES
#pragma GCC push_options
#pragma GCC target("avx2")
#define DEGS_WIDE_MOVEMASK
namespace wide {
constexpr int kLanes = 8;
#include "splat/blend_kernel.inc"
} // namespace wide
#pragma GCC pop_options
#endif

namespace {

bool has_wide_lanes() {
#ifdef DEGS_HAS_WIDE_LANES
    return __builtin_cpu_supports("avx2") != 0;
#else
    return false;
#endif
}

} // namespace

BlendFunction<float> blend_function(float /*type*/) {
#ifdef DEGS_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        return &wide::blend_float;
    }
#endif
    return &narrow::blend_float;
}

BlendFunction<double> blend_function(double /*type*/) {
    return &narrow::blend_double;
}

TestFunction<float> test_function(float /*type*/) {
#ifdef DEGS_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        return &wide::test_float;
    }
#endif
    return &narrow::test_float;
}

TestFunction<double> test_function(double /*type*/) {
    return &narrow::test_double;
}

std::vector<BlendFunction<float>> blend_variants() {
    std::vector<BlendFunction<float>> variants{&narrow::blend_float};
#ifdef DEGS_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        variants.push_back(&wide::blend_float);
    }
#endif
    return variants;
}

std::vector<TestFunction<float>> test_variants() {
    std::vector<TestFunction<float>> variants{&narrow::test_float};
#ifdef DEGS_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        variants.push_back(&wide::test_float);
    }
#endif
    return variants;
}

float lane_exp(float x) {
    narrow::Lanes<float>::Value lanes{};
    return narrow::exponential(lanes + x)[0];
}

} // namespace degs
