// SPDX-License-Identifier: Apache-2.0
// Rounding of float arrays, once per instruction set.
#include <cstring>

#include "splat/numbers/number_format.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "splat/numbers/rounding_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace degs::HWY_NAMESPACE {
#include "splat/numbers/rounding.inc"

/// Whole vectors first; the rest goes through a copy, so that every value takes the same way.
void round_array(const LaneRounding& to, float* values, std::size_t count) {
    constexpr std::size_t kStep = kLanes<float>;
    const Tag<float> lanes;
    const LaneRounding constants = to; // a copy, which the stores below cannot change
    const std::size_t whole = count / kStep * kStep;
    for (std::size_t i = 0; i < whole; i += kStep) {
        hn::StoreU(round_lanes(hn::LoadU(lanes, values + i), constants), lanes, values + i);
    }
    float rest[kStep] = {};
    std::memcpy(rest, values + whole, (count - whole) * sizeof(float));
    hn::StoreU(round_lanes(hn::LoadU(lanes, rest), constants), lanes, rest);
    std::memcpy(values + whole, rest, (count - whole) * sizeof(float));
}

RoundFunction rounder() {
    return &round_array;
}

} // namespace degs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "splat/numbers/instruction_set.hpp"

namespace degs {
HWY_EXPORT(rounder);

std::vector<RoundFunction> round_variants() {
    return of_all_targets([] { return HWY_DYNAMIC_DISPATCH(rounder)(); });
}

} // namespace degs
#endif
