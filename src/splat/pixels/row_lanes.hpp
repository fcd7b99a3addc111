// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "splat/numbers/number_set.hpp"
#include "splat/pixels/data_path.hpp"
#include "splat/pixels/quantized_row.hpp"

namespace degs {

/// What a Span Unit needs to know of a number set.
struct RowNumbers {
    explicit RowNumbers(const NumberSet& set);

    Vertical vertical;
    SpanEnds ends;
    Base base;
    double delta, guard;
    double half_unit;      ///< of the mean, px
    bool ratio_passes_one; ///< the format of x has values above 1
    RoundingConstants distance, square, ratio, edge, level, g0, d0;
    LookupTable sqrt;
};

/// Image rows y, y + step, ... of one splat.
struct RowsToSolve {
    int y = 0, step = 1, count = 0; ///< count: up to 64
    int x_begin = 0, x_end = 0;     ///< columns
};

/// The span in columns from x_begin on, without splat and row; its length is 0 if it is empty.
RowSpan row_span(const QuantizedSpan& span, int x_begin);

/// Solves the rows as QuantizedRow::solve does, several at once, into the spans that row_span()
/// makes of them, and returns those that it leaves out, bit by bit: there an operation has left the
/// range in which the values of a format round alike.
using SolveRowsFunction = std::uint64_t (*)(const RowNumbers& numbers, const QuantizedSplat& splat,
                                            const RowsToSolve& rows, RowSpan* spans);
/// With the widest vectors of the machine it runs on; the same bits at any width.
SolveRowsFunction solve_rows_function();
/// All variants this build has, narrow first; those the machine cannot run are left out. For tests.
std::vector<SolveRowsFunction> solve_rows_variants();

} // namespace degs
