// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/quantized_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "degs/error.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "splat/pixels/quantized_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef DEGS_QUANTIZED_LANES
#define DEGS_QUANTIZED_LANES // this file is read once per instruction set
namespace degs {
namespace {
/// Tables of up to as many cells may be looked up in registers; LaneNumbers pads them to it.
constexpr int kFewCells = 16;

/// Both functions of a PE.
struct Variant {
    QuantizedBlendFunction blend;
    QuantizedTestFunction test;
};
} // namespace
} // namespace degs
#endif

HWY_BEFORE_NAMESPACE();
namespace degs::HWY_NAMESPACE {
#include "splat/pixels/quantized_kernel.inc"

Variant variant(LaneFamily family) {
    switch (family) {
    case LaneFamily::Fixed:
        return {&blend_run<LaneFamily::Fixed>, &test_run<LaneFamily::Fixed>};
    case LaneFamily::Half:
        return {&blend_run<LaneFamily::Half>, &test_run<LaneFamily::Half>};
    case LaneFamily::Any:
        break;
    }
    return {&blend_run<LaneFamily::Any>, &test_run<LaneFamily::Any>};
}
} // namespace degs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "splat/numbers/instruction_set.hpp"

namespace degs {
HWY_EXPORT(variant);

namespace {

bool is_power_of_two(double value) {
    int exponent = 0;
    return value > 0 && std::frexp(value, &exponent) == 0.5;
}

/// The formats that PEs round to; the first are those of operands, which they only read.
std::vector<NumberFormat> pe_results(const NumberSet& set) {
    std::vector<NumberFormat> results = {set.exp.values};
    for (const NumberStage& stage : number_stages()) {
        if (std::strncmp(stage.unit, "pe.", 3) == 0) {
            results.push_back(set.*stage.format);
        }
    }
    if (set.exp.function == TableFunction::ExpHalf && set.exp.reduction == Reduction::Binary) {
        results.push_back(set.exp.argument);
    }
    return results;
}

LaneFamily family_of(const NumberSet& set) {
    const NumberFormat half = parse_format("fp16");
    bool fixed = true;
    bool halves = true;
    for (const NumberFormat& format : pe_results(set)) {
        halves = halves && format == half;
        fixed = fixed && format.kind == NumberFormat::Kind::Fixed && format.magnitude_bits() <= 22;
    }
    fixed =
        fixed && set.term.has_sign && set.weight.max() > 0.995 && set.exp.values.max() >= 1 &&
        (set.exp.reduction == Reduction::Binary || set.exp.interpolation == Interpolation::Nearest);
    return halves ? LaneFamily::Half : fixed ? LaneFamily::Fixed : LaneFamily::Any;
}

} // namespace

bool lanes_can(const NumberSet& set) {
    std::vector<NumberFormat> formats = pe_results(set);
    formats.insert(formats.end(), {set.conic, set.g0, set.d0, set.colour, set.exp.values});
    if (!set.exp.argument.is_fp64()) { // else nothing is rounded to it
        formats.push_back(set.exp.argument);
    }
    for (const NumberFormat& format : formats) {
        if (format.is_fp64() || !format.fits_float()) {
            return false;
        }
    }
    return set.exp.interpolation != Interpolation::Exact && is_power_of_two(set.exp.entries) &&
           (set.exp.reduction == Reduction::Binary || is_power_of_two(set.exp.range));
}

LaneNumbers::LaneNumbers(const NumberSet& set)
    : term(set.term), q(set.q), alpha(set.alpha), transmittance(set.transmittance),
      weight(set.weight), sum(set.sum), table(set.exp.values) {
    if (!lanes_can(set)) {
        throw InputError("The number set '" + set.name +
                         "' has formats or tables that the lanes "
                         "of the array cannot compute.");
    }
    if (!set.exp.argument.is_fp64()) { // else nothing is rounded to it
        argument = LaneRounding(set.exp.argument);
    }
    masked = set.q_mask;
    alpha_max = static_cast<float>(Rounder(set.alpha)(0.99));
    term_room = term.high - 4 * static_cast<float>(set.term.quantum());
    reduced = set.exp.reduction == Reduction::Binary;
    natural = set.exp.function == TableFunction::ExpHalf;
    family = family_of(set);
    from_start = set.base == Base::Start;
    half_lookup = set.multiplier == IntegerMultiplier::HalfLookup;
    low_mask = (1 << set.lookup_bits) - 1;
    cells_per_unit =
        static_cast<float>(reduced ? set.exp.entries : set.exp.entries / set.exp.range);
    last_cell = set.exp.entries - 1;
    const LookupTable cells(set.exp);
    values = cells.lane_values();
    falls = cells.lane_falls();
    values.resize(std::max<std::size_t>(values.size(), kFewCells));
    falls.resize(values.size());
}

std::vector<QuantizedBlendFunction> quantized_blend_variants(LaneFamily family) {
    return of_all_targets([family] { return HWY_DYNAMIC_DISPATCH(variant)(family).blend; });
}

std::vector<QuantizedTestFunction> quantized_test_variants(LaneFamily family) {
    return of_all_targets([family] { return HWY_DYNAMIC_DISPATCH(variant)(family).test; });
}

QuantizedBlendFunction quantized_blend_function(LaneFamily family) {
    return HWY_DYNAMIC_DISPATCH(variant)(family).blend;
}

QuantizedTestFunction quantized_test_function(LaneFamily family) {
    return HWY_DYNAMIC_DISPATCH(variant)(family).test;
}

} // namespace degs
#endif
