// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/row_lanes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "splat/frame/pixel_index.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "splat/pixels/row_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace degs::HWY_NAMESPACE {
#include "splat/pixels/row_kernel.inc"
SolveRowsFunction solver() {
    return &solve_rows;
}
} // namespace degs::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "splat/numbers/instruction_set.hpp"

namespace degs {
HWY_EXPORT(solver);

RowNumbers::RowNumbers(const NumberSet& set)
    : vertical(set.vertical), ends(set.ends), base(set.base), delta(set.delta), guard(set.guard),
      half_unit(0.5 * std::ldexp(1.0, -set.mean.fraction_bits)),
      ratio_passes_one(set.ratio.max() > 1), distance(set.distance), square(set.square),
      ratio(set.ratio), edge(set.edge), level(set.level), g0(set.g0), d0(set.d0), sqrt(set.sqrt) {}

RowSpan row_span(const QuantizedSpan& span, int x_begin) {
    RowSpan row;
    if (!span.empty()) {
        row.x0 = inside_tile(span.x0 - x_begin);
        row.length = inside_tile(span.x1 - span.x0 + 1);
        row.base = inside_tile(span.base - x_begin);
        row.g0 = span.g0;
        row.d0 = span.d0;
    }
    return row;
}

SolveRowsFunction solve_rows_function() {
    return HWY_DYNAMIC_DISPATCH(solver)();
}

std::vector<SolveRowsFunction> solve_rows_variants() {
    return of_all_targets([] { return HWY_DYNAMIC_DISPATCH(solver)(); });
}

} // namespace degs
#endif
