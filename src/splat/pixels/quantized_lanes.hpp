// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "splat/pixels/blend_lanes.hpp"
#include "splat/pixels/quantized_row.hpp"

namespace degs {

/// How the lanes round. `Any`: in integer arithmetic. `Half`: every stage is fp16. `Fixed`: some
/// results need no saturation, because four conditions hold:
/// * Every stage of the PE is a fixed format of at most 22 bits without the sign.
/// * Terms have a sign.
/// * Weights reach 0.99.
/// * Table values reach 1 and are never below 0.
enum class LaneFamily { Any, Fixed, Half };

/// The PE of a number set as constants for lanes of floats: QuantizedRow::q, alpha and blend for
/// neighbouring pixels at once. A float carries 24 bits, so a product of more is rounded twice: to
/// 24 bits, then to its format. All else is the same bit by bit.
struct LaneNumbers {
    LaneFamily family = LaneFamily::Any;
    LaneRounding term, q, alpha, transmittance, weight, sum;
    LaneRounding table, argument;  ///< of the exponential's table
    bool masked = false;           ///< q above the splat's limit draws nothing
    float alpha_max = 0;           ///< 0.99 in the format of alpha
    float term_room = 0;           ///< Fixed: below it, |n d0| + |A n(n-1)| do not saturate
    bool natural = false;          ///< ExpHalf: q log2(e) / 2 is formed first
    float to_binary = 0.72134752F; ///< log2(e) / 2
    bool reduced = false;          ///< Reduction::Binary
    bool from_start = true;        ///< Base::Start: g0 + n d0 first
    bool half_lookup = false;
    std::int32_t low_mask = 15; ///< of the bits of the lower half
    float cells_per_unit = 1;
    std::int32_t last_cell = 0;
    std::vector<float> values, falls; ///< of the table's cells

    /// Throws InputError unless lanes_can(set).
    explicit LaneNumbers(const NumberSet& set);
};

/// Lanes need formats of at most fp32 in the PE, and a table of the exponential with a power of two
/// of cells over a power of two.
bool lanes_can(const NumberSet& set);

/// The PE for up to 32 neighbouring pixels, see BlendFunction: q_n, alpha, recurrence, stop rule,
/// every operation rounded. `task.offset` counts from the span's base.
using QuantizedBlendFunction = BlendOutcome (*)(const BlendTask& task,
                                                const BlendRecord<float>& splat,
                                                const LaneNumbers& numbers, bool refuse,
                                                PixelPlanes<float>& pixels, std::size_t first);
/// Pixels with the result of their own check.
struct TestedPixels {
    std::uint32_t mask = 0;
    float q[32 + kLanePadding] = {}; ///< of mask bit i
};
/// A PE that blends where q <= the limit of the splat, otherwise like QuantizedBlendFunction; all
/// else is boundary.
using QuantizedTestFunction = BlendOutcome (*)(const TestedPixels& tested,
                                               const BlendRecord<float>& splat,
                                               const LaneNumbers& numbers, bool refuse,
                                               PixelPlanes<float>& pixels, std::size_t first);

/// The functions for numbers of a family, with the widest vectors of the machine it runs on.
QuantizedBlendFunction quantized_blend_function(LaneFamily family);
QuantizedTestFunction quantized_test_function(LaneFamily family);
/// For tests: all variants for a family that this build has and the machine can run.
std::vector<QuantizedBlendFunction> quantized_blend_variants(LaneFamily family);
std::vector<QuantizedTestFunction> quantized_test_variants(LaneFamily family);

} // namespace degs
