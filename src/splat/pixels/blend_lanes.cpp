// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/blend_lanes.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "splat/pixels/blend_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace degs::HWY_NAMESPACE {
#include "splat/pixels/blend_kernel.inc"
#include "splat/pixels/rasterise_kernel.inc"

BlendFunction<float> blend() {
    return &blend_run<float>;
}
TestFunction<float> test() {
    return &test_rows<float>;
}
ProductFunction<float> product() {
    return &product_rows<float>;
}
RasteriseFunction rasterise() {
    return &rasterise_rows;
}

// The reference, for the least instruction set alone.
#if HWY_ONCE
BlendFunction<double> blend_double() {
    return &blend_run<double>;
}
TestFunction<double> test_double() {
    return &test_rows<double>;
}
ProductFunction<double> product_double() {
    return &product_rows<double>;
}
float exponential_of(float x) {
    return hn::GetLane(exponential(all(x)));
}
#endif
} // namespace degs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "splat/numbers/instruction_set.hpp"

namespace degs {
HWY_EXPORT(blend);
HWY_EXPORT(test);
HWY_EXPORT(product);
HWY_EXPORT(rasterise);

std::vector<BlendFunction<float>> blend_variants() {
    return of_all_targets([] { return HWY_DYNAMIC_DISPATCH(blend)(); });
}

std::vector<TestFunction<float>> test_variants() {
    return of_all_targets([] { return HWY_DYNAMIC_DISPATCH(test)(); });
}

std::vector<ProductFunction<float>> product_variants() {
    return of_all_targets([] { return HWY_DYNAMIC_DISPATCH(product)(); });
}

std::vector<RasteriseFunction> rasterise_variants() {
    return of_all_targets([] { return HWY_DYNAMIC_DISPATCH(rasterise)(); });
}

RasteriseFunction rasterise_function() {
    return HWY_DYNAMIC_DISPATCH(rasterise)();
}

BlendFunction<float> blend_function(float /*type*/) {
    return HWY_DYNAMIC_DISPATCH(blend)();
}

BlendFunction<double> blend_function(double /*type*/) {
    return HWY_STATIC_DISPATCH(blend_double)();
}

TestFunction<float> test_function(float /*type*/) {
    return HWY_DYNAMIC_DISPATCH(test)();
}

TestFunction<double> test_function(double /*type*/) {
    return HWY_STATIC_DISPATCH(test_double)();
}

ProductFunction<float> product_function(float /*type*/) {
    return HWY_DYNAMIC_DISPATCH(product)();
}

ProductFunction<double> product_function(double /*type*/) {
    return HWY_STATIC_DISPATCH(product_double)();
}

float lane_exp(float x) {
    return HWY_STATIC_DISPATCH(exponential_of)(x);
}

} // namespace degs
#endif
