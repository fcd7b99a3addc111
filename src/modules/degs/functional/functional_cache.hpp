// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/shared_bytes.hpp"
#include "modules/degs/functional/functional_model.hpp"
#include "modules/degs/functional/row_batch.hpp"
#include "modules/degs/functional/tile_contexts.hpp"
#include "modules/degs/functional/tile_trace.hpp"

namespace degs {

/// Takes the traces of tiles that another simulation of the same frames has kept, and keeps those
/// of the tiles that it rasterises itself: designs that differ in buffers, queues or memory have
/// the same traces. A trace goes up to the end of the tile's last live pixel and a little further,
/// like the work of FunctionalThread; rows behind that are rasterised on demand, over pixels that
/// have all ended.
class FunctionalCache final : public FunctionalModel {
public:
    /// `pixels` names what the pixels of the job's frames depend on beside them, see
    /// KeptTiles.
    FunctionalCache(RenderJob& job, const FunctionalOptions& options, const std::string& pixels,
                    SharedBytes& kept);

    PixelRange rows(TileNumber number, std::uint32_t place) override;
    void take(TileNumber number, std::uint32_t place, const PixelRange& own, int step,
              RowOutcome* outcomes) override;
    void read_row(TileNumber number, int row, int count, PixelValue* pixels) override;
    void clear_row(TileNumber number, int row) override;

private:
    static constexpr int kNone = -1;

    struct Tile {
        JobTile job;
        TileTraceReader kept; ///< without batches if nobody has kept the tile
        int context = kNone;  ///< of a tile that is rasterised here; see restore_context()
        TileTraceWriter writer;
        std::vector<PixelValue> pixels; ///< row by row, if they will be kept
        std::int64_t live = 0;          ///< pixels that have not ended
        int batches_after_end = 0;      ///< from the one in which the last pixel ended on
        std::vector<std::unique_ptr<RowBatch>> batches; ///< of the list, while somebody needs them
        std::uint32_t made = 0;                         ///< batches so far
        int cleared = 0;                                ///< rows that the simulation has cleared
        bool is_kept() const { return kept.batches() != 0; }
    };

    std::string key(const JobTile& tile) const;
    Tile& tile(TileNumber number);
    RowBatch& batch(Tile& tile, std::uint32_t place);
    void make_batch(Tile& tile);
    void rasterise_batch(Tile& tile, RowBatch& batch);
    void restore_context(Tile& tile);
    void keep_pixels(Tile& tile);

    RenderJob& job_;
    FunctionalOptions options_;
    SharedBytes& kept_;
    std::string name_; ///< of these pixels, the first part of all keys
    TileContexts contexts_;
    KeptList<std::unique_ptr<Tile>> tiles_; ///< by number; null: not begun, or over
    std::vector<std::unique_ptr<RowBatch>> free_batches_;
};

} // namespace degs
