// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "splat/pixels/data_path.hpp"

namespace degs {

/// A data path in the formats of `set`: records, rows and pixels are those of QuantizedRow, value
/// by value (products of the PE as in quantized_lanes.hpp). Span ends and stop rule are those of
/// `options`. All values are finite for every splat. Not modelled: rows per splat and per tile
/// (rows, rows_in_columns) are bounds, worked out in double.
std::unique_ptr<DataPath> make_quantized_data_path(const NumberSet& set,
                                                   const DataPathOptions& options, int tile_size,
                                                   int contexts);

} // namespace degs
