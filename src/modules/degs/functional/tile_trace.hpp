// SPDX-License-Identifier: Apache-2.0
// A drawn tile as bytes of this machine, a few for each row.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "modules/degs/functional/row_batch.hpp"

namespace degs {

/// Collects the batches and pixels of a tile.
class TileTraceWriter {
public:
    /// The next batch, which has the drawn rows of `splats` splats.
    void add(const RowBatch& batch, std::uint32_t splats);
    /// The bytes of the batches that were added, and of the pixels of the tile, row by row.
    std::string bytes(const std::vector<PixelValue>& pixels) const;

private:
    std::vector<std::uint32_t> ends_; // of the batches, in rows_
    std::string rows_;
};

/// Reads what TileTraceWriter has written; the bytes outlive it.
class TileTraceReader {
public:
    TileTraceReader() = default;
    explicit TileTraceReader(std::string_view bytes);

    /// Sheets that it has; 0 without bytes.
    std::uint32_t batches() const { return batches_; }
    /// Puts batch `index`, of so many splats, into an empty one; `takes` stays.
    void read(std::uint32_t index, std::uint32_t splats, RowBatch& batch) const;
    /// `count` pixels from number `first` on, row by row.
    void read_pixels(std::size_t first, std::size_t count, PixelValue* pixels) const;

private:
    std::uint32_t batches_ = 0;
    const char* ends_ = nullptr;
    const char* rows_ = nullptr;
    const char* pixels_ = nullptr;
    bool single_ = false; // pixels are in single precision
};

} // namespace degs
