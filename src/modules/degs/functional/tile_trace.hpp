// SPDX-License-Identifier: Apache-2.0
// The functional trace of a tile in few bytes: the outcomes of all its rows, and its final pixels.
// Numbers are in the byte order of this machine, because traces are kept in memory alone.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "modules/degs/functional/row_batch.hpp"

namespace degs {

/// Writes the trace of a tile, batch by batch.
class TileTraceWriter {
public:
    /// Appends the next batch, which has the rows of `splats` splats.
    void add(const RowBatch& batch, std::uint32_t splats);
    /// The trace of the batches that were added, with the pixels of the tile, row by row.
    std::string bytes(const std::vector<PixelValue>& pixels) const;

private:
    std::vector<std::uint32_t> ends_; // of the batches, in rows_
    std::string rows_;
};

/// Reads what TileTraceWriter has written. The bytes must outlive the reader.
class TileTraceReader {
public:
    TileTraceReader() = default;
    explicit TileTraceReader(std::string_view bytes);

    /// The number of batches in the trace; 0 if there are no bytes.
    std::uint32_t batches() const { return batches_; }
    /// Reads batch `index`, which has so many splats, into an empty one. `takes` stays as it is.
    void read(std::uint32_t index, std::uint32_t splats, RowBatch& batch) const;
    /// Reads `count` pixels from number `first` on; pixels are numbered row by row.
    void read_pixels(std::size_t first, std::size_t count, PixelValue* pixels) const;

private:
    std::uint32_t batches_ = 0;
    const char* ends_ = nullptr;
    const char* rows_ = nullptr;
    const char* pixels_ = nullptr;
    bool single_ = false; // pixels are in single precision
};

} // namespace degs
