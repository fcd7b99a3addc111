// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/shared_bytes.hpp"
#include "modules/degs/drawing/drawn_sheet.hpp"
#include "modules/degs/drawing/drawn_tile_code.hpp"
#include "modules/degs/drawing/tile_canvases.hpp"
#include "modules/degs/drawing/tile_drawing.hpp"

namespace degs {

/// Takes tiles that another simulation of the same frames has drawn, and keeps those that it draws
/// itself: designs that differ in buffers, queues or memory draw the same pixels. A tile is kept up
/// to its last live pixel and a little further, as DrawingThread draws it ahead; what lies behind
/// is drawn on demand, over pixels that have all ended.
class KeptDrawing final : public TileDrawing {
public:
    /// `pixels` names what the pixels of the job's frames depend on beside them, see
    /// KeptTiles.
    KeptDrawing(RenderJob& job, const DrawingOptions& options, const std::string& pixels,
                SharedBytes& kept);

    PixelRange rows(TileNumber number, std::uint32_t place) override;
    void take(TileNumber number, std::uint32_t place, const PixelRange& own, int step,
              DrawnRow* drawn) override;
    void read_row(TileNumber number, int row, int count, PixelValue* pixels) override;
    void clear_row(TileNumber number, int row) override;

private:
    static constexpr int kNone = -1;

    struct Tile {
        JobTile job;
        DrawnTileReader kept; ///< without sheets if nobody has kept the tile
        int canvas = kNone;   ///< nobody has kept it, or not far enough
        DrawnTileWriter writer;
        std::vector<PixelValue> pixels;                  ///< row by row, if they will be kept
        std::int64_t live = 0;                           ///< pixels that have not ended
        int sheets_after_end = 0;                        ///< with the one in which the tile ended
        std::vector<std::unique_ptr<DrawnSheet>> sheets; ///< of the list, while somebody needs them
        std::uint32_t made = 0;                          ///< of them
        int cleared = 0;                                 ///< rows
        bool is_kept() const { return kept.sheets() != 0; }
    };

    std::string key(const JobTile& tile) const;
    Tile& tile(TileNumber number);
    DrawnSheet& sheet(Tile& tile, std::uint32_t place);
    void make_sheet(Tile& tile);
    void draw_sheet(Tile& tile, DrawnSheet& sheet);
    void end_canvas(Tile& tile);
    void keep_pixels(Tile& tile);

    RenderJob& job_;
    DrawingOptions options_;
    SharedBytes& kept_;
    std::string name_; ///< of these pixels, the first part of all keys
    TileCanvases canvases_;
    KeptList<std::unique_ptr<Tile>> tiles_; ///< by number; null: not begun, or over
    std::vector<std::unique_ptr<DrawnSheet>> free_sheets_;
};

} // namespace degs
