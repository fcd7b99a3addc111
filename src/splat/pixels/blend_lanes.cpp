// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/blend_lanes.hpp"

#include <cmath>
#include <cstring>

#include "splat/numbers/instruction_set.hpp"

#ifdef DEGS_HAS_WIDE_LANES
#include <immintrin.h>
#endif

namespace degs {
namespace narrow {
constexpr int kLanes = 4;
#include "splat/pixels/blend_kernel.inc"
#include "splat/pixels/rasterise_kernel.inc"
} // namespace narrow

#ifdef DEGS_HAS_WIDE_LANES
#pragma GCC push_options
#pragma GCC target("avx2")
#define DEGS_WIDE_MOVEMASK
namespace wide {
constexpr int kLanes = 8;
#include "splat/pixels/blend_kernel.inc"
#include "splat/pixels/rasterise_kernel.inc"
} // namespace wide
#undef DEGS_WIDE_MOVEMASK
#pragma GCC pop_options
#else
namespace wide = narrow;
#endif

std::vector<BlendFunction<float>> blend_variants() {
    return runnable<BlendFunction<float>>({&narrow::blend_float, &wide::blend_float});
}

std::vector<TestFunction<float>> test_variants() {
    return runnable<TestFunction<float>>({&narrow::test_float, &wide::test_float});
}

std::vector<ProductFunction<float>> product_variants() {
    return runnable<ProductFunction<float>>({&narrow::product_float, &wide::product_float});
}

std::vector<RasteriseFunction> rasterise_variants() {
    return runnable<RasteriseFunction>({&narrow::rasterise_float, &wide::rasterise_float});
}

RasteriseFunction rasterise_function() {
    return rasterise_variants().back();
}

BlendFunction<float> blend_function(float /*type*/) {
    return blend_variants().back();
}

BlendFunction<double> blend_function(double /*type*/) {
    return &narrow::blend_double;
}

TestFunction<float> test_function(float /*type*/) {
    return test_variants().back();
}

TestFunction<double> test_function(double /*type*/) {
    return &narrow::test_double;
}

ProductFunction<float> product_function(float /*type*/) {
    return product_variants().back();
}

ProductFunction<double> product_function(double /*type*/) {
    return &narrow::product_double;
}

float lane_exp(float x) {
    narrow::Lanes<float>::Value lanes{};
    return narrow::exponential(lanes + x)[0];
}

} // namespace degs
