// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "baselines/orange/config.hpp"

namespace degs::orange {

/// A core without cycles, batch by batch: its vector unit forms the coefficients of a batch and
/// blends its product, which comes first, and the systolic array is between the two. Batches of
/// different sizes make each wait for the other. Splats are always there.
class BatchDates {
public:
    struct Tile {
        double cycles = 0; ///< from the end of a tile to that of the next one like it
        double formed = 0; ///< splats of the products of a tile, also of those that nobody blends
    };

    explicit BatchDates(const Config& config) : config_(config) {}
    /// Tiles whose lists have `entries` splats, and whose pixels have ended after `blended`
    /// batches.
    Tile tile(std::size_t entries, std::size_t blended);

private:
    /// Tiles in the core one after the other. Two are measured, because places for two batches may
    /// make every other tile wait; those before fill the core, and one follows.
    static constexpr std::size_t kTiles = 5, kMeasured = 2;
    static constexpr std::size_t kFirst = kTiles - kMeasured - 1;
    struct Batch {
        std::size_t tile = 0, place = 0; ///< in the tile
        int splats = 0;
        double coefficients = 0, product = 0, blended = 0; ///< dates
    };
    void begin(std::size_t entries, std::size_t blended);
    bool has_chunk() const { return next_tile_ < kTiles; }
    bool has_room() const;
    void take_chunk();
    void multiply();
    void blend();
    int splats_of(std::size_t place) const;

    const Config& config_;
    std::size_t entries_ = 0, batches_ = 0, needed_ = 0; ///< of a tile
    std::size_t next_tile_ = 0, next_place_ = 0;         ///< the next chunk
    std::vector<Batch> formed_;                          ///< all whose coefficients were formed
    std::size_t multiplied_ = 0, blended_ = 0;           ///< of them
    std::size_t ended_ = 0;                              ///< tiles below it have ended
    double vector_ = 0, array_ = 0;                      ///< when the units are free
    std::vector<double> ends_;                           ///< of the tiles
};

} // namespace degs::orange
