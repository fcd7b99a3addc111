// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/quantized_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "degs/error.hpp"
#include "splat/numbers/instruction_set.hpp"

#ifdef DEGS_HAS_WIDE_LANES
#include <immintrin.h>
#endif

namespace degs {
namespace {
/// Tables of up to as many cells may be looked up in registers; LaneNumbers pads them to it.
constexpr int kFewCells = 16;
} // namespace

namespace narrow_numbers {
constexpr int kLanes = 4;
#include "splat/numbers/rounding.inc"
using Value = FloatLanes;
using Bits = IntLanes;
inline Value floor_lanes(const Value& x) {
    const Value cut = __builtin_convertvector(__builtin_convertvector(x, Bits), Value);
    return cut > x ? cut - 1.0F : cut;
}
inline Value look_up(const float* table, const Bits& cell, bool /*few*/) {
    return Value{table[cell[0]], table[cell[1]], table[cell[2]], table[cell[3]]};
}
inline Value round_half(const Value& x, const LaneRounding& to) {
    return round_lanes<Value, Bits>(x, to);
}
#include "splat/pixels/quantized_kernel.inc"
} // namespace narrow_numbers

#ifdef DEGS_HAS_WIDE_LANES
#pragma GCC push_options
#pragma GCC target("avx2,f16c")
#define DEGS_WIDE_MOVEMASK
namespace wide_numbers {
constexpr int kLanes = 8;
#include "splat/numbers/rounding.inc"
using Value = FloatLanes;
using Bits = IntLanes;
inline Value floor_lanes(const Value& x) {
    return same_bits<Value>(_mm256_floor_ps(same_bits<__m256>(x)));
}
inline Value look_up(const float* table, const Bits& cell, bool few) {
    const auto cells = same_bits<__m256i>(cell);
    if (!few) {
        return same_bits<Value>(_mm256_i32gather_ps(table, cells, 4));
    }
    const __m256 low = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table), cells);
    const __m256 high = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table + 8), cells);
    const __m256 is_high = _mm256_castsi256_ps(_mm256_slli_epi32(cells, 28)); // bit 3 as sign
    return same_bits<Value>(_mm256_blendv_ps(low, high, is_high));
}
inline Value round_half(const Value& x, const LaneRounding& /*fp16*/) {
    const __m128i halves = _mm256_cvtps_ph(same_bits<__m256>(x), _MM_FROUND_TO_NEAREST_INT);
    return same_bits<Value>(_mm256_cvtph_ps(halves));
}
#include "splat/pixels/quantized_kernel.inc"
} // namespace wide_numbers
#pragma GCC pop_options

// A segment of 16 px in one block, a table of 16 cells in one register.
#pragma GCC push_options
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl")
#define DEGS_WIDEST_MOVEMASK
namespace widest_numbers {
constexpr int kLanes = 16;
#include "splat/numbers/rounding.inc"
using Value = FloatLanes;
using Bits = IntLanes;
// The forms that zero what a mask leaves out: g++ 12 takes those without a mask for uninitialised.
constexpr __mmask16 kAllLanes = 0xFFFF;
inline Value floor_lanes(const Value& x) {
    return same_bits<Value>(_mm512_maskz_roundscale_ps(kAllLanes, same_bits<__m512>(x),
                                                       _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC));
}
inline Value look_up(const float* table, const Bits& cell, bool few) {
    const auto cells = same_bits<__m512i>(cell);
    return same_bits<Value>(
        few ? _mm512_maskz_permutexvar_ps(kAllLanes, cells, _mm512_loadu_ps(table))
            : _mm512_mask_i32gather_ps(_mm512_setzero_ps(), kAllLanes, cells, table, 4));
}
inline Value round_half(const Value& x, const LaneRounding& /*fp16*/) {
    const __m256i halves =
        _mm512_maskz_cvtps_ph(kAllLanes, same_bits<__m512>(x), _MM_FROUND_TO_NEAREST_INT);
    return same_bits<Value>(_mm512_maskz_cvtph_ps(kAllLanes, halves));
}
#include "splat/pixels/quantized_kernel.inc"
} // namespace widest_numbers
#undef DEGS_WIDEST_MOVEMASK
#undef DEGS_WIDE_MOVEMASK
#pragma GCC pop_options
#else
namespace wide_numbers = narrow_numbers;
namespace widest_numbers = narrow_numbers;
#endif

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

/// Both functions of a PE.
struct Variant {
    QuantizedBlendFunction blend;
    QuantizedTestFunction test;
};

template <LaneFamily family>
std::vector<Variant> variants_of() {
    return runnable<Variant>(
        {{&narrow_numbers::blend_run<family>, &narrow_numbers::test_run<family>},
         {&wide_numbers::blend_run<family>, &wide_numbers::test_run<family>},
         {&widest_numbers::blend_run<family>, &widest_numbers::test_run<family>}});
}

std::vector<Variant> variants(LaneFamily family) {
    switch (family) {
    case LaneFamily::Fixed:
        return variants_of<LaneFamily::Fixed>();
    case LaneFamily::Half:
        return variants_of<LaneFamily::Half>();
    case LaneFamily::Any:
        break;
    }
    return variants_of<LaneFamily::Any>();
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
    std::vector<QuantizedBlendFunction> functions;
    for (const Variant& variant : variants(family)) {
        functions.push_back(variant.blend);
    }
    return functions;
}

std::vector<QuantizedTestFunction> quantized_test_variants(LaneFamily family) {
    std::vector<QuantizedTestFunction> functions;
    for (const Variant& variant : variants(family)) {
        functions.push_back(variant.test);
    }
    return functions;
}

QuantizedBlendFunction quantized_blend_function(LaneFamily family) {
    return variants(family).back().blend;
}

QuantizedTestFunction quantized_test_function(LaneFamily family) {
    return variants(family).back().test;
}

} // namespace degs
