// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/row_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "splat/frame/pixel_index.hpp"
#include "splat/numbers/instruction_set.hpp"

#ifdef DEGS_HAS_WIDE_LANES
#include <immintrin.h>
#endif

namespace degs {

namespace narrow_rows {
constexpr int kLanes = 2;
#include "splat/pixels/row_kernel.inc"
} // namespace narrow_rows

#ifdef DEGS_HAS_WIDE_LANES
#pragma GCC push_options
#pragma GCC target("avx2")
namespace wide_rows {
constexpr int kLanes = 4;
#include "splat/pixels/row_kernel.inc" // NOLINT(readability-duplicate-include)
} // namespace wide_rows
#pragma GCC pop_options
#else
namespace wide_rows = narrow_rows;
#endif

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

std::vector<SolveRowsFunction> solve_rows_variants() {
    return runnable<SolveRowsFunction>({&narrow_rows::solve_rows, &wide_rows::solve_rows});
}

SolveRowsFunction solve_rows_function() {
    static const SolveRowsFunction widest = solve_rows_variants().back();
    return widest;
}

} // namespace degs
