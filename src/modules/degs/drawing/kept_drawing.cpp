// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/drawing/kept_drawing.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace degs {
namespace {

// A short name of the text, which is long: where it lies, which is the same for all who share it.
// Empty if it cannot be kept.
std::string short_name(SharedBytes& kept, const std::string& text) {
    kept.put(text, "");
    const char* const place = kept.find(text).data();
    std::string name;
    if (place != nullptr) {
        name.resize(sizeof place);
        std::memcpy(name.data(), &place, sizeof place);
    }
    return name;
}

template <class T>
void append(std::string& to, T number) {
    to.append(reinterpret_cast<const char*>(&number), sizeof number);
}

} // namespace

KeptDrawing::KeptDrawing(RenderJob& job, const DrawingOptions& options, const std::string& pixels,
                         SharedBytes& kept)
    : job_(job), options_(options), kept_(kept),
      name_(short_name(kept, pixels + (options.tests ? "tests " : "") +
                                 std::to_string(static_cast<int>(options.rows)) + " " +
                                 std::to_string(job.tile_size))),
      canvases_(job, options.tests) {}

std::string KeptDrawing::key(const JobTile& tile) const {
    std::string key = name_;
    append(key, tile.frame);
    append(key, tile.x);
    append(key, tile.y);
    return key;
}

KeptDrawing::Tile& KeptDrawing::tile(TileNumber number) {
    while (number >= tiles_.size()) {
        tiles_.emplace_back();
    }
    std::unique_ptr<Tile>& place = tiles_[number];
    if (place == nullptr) {
        place = std::make_unique<Tile>();
        place->job = job_.tiles[number];
        place->live = place->job.pixels();
        place->sheets.resize(DrawnSheet::sheets_of(place->job));
        if (!name_.empty()) {
            place->kept = DrawnTileReader(kept_.find(key(place->job)));
        }
        if (!place->is_kept()) {
            place->canvas = canvases_.open();
        }
    }
    return *place;
}

// The pixels of a kept tile behind its last sheet: all in the image have ended, or nobody would ask
// for more.
void KeptDrawing::end_canvas(Tile& tile) {
    tile.canvas = canvases_.open();
    std::vector<PixelValue> pixels(tile.job.width);
    const PixelRange rows = tile.job.drawn_rows(), columns = tile.job.drawn_columns();
    for (int row = rows.first; row <= rows.last; ++row) {
        tile.kept.read_pixels(std::size_t{1} * row * tile.job.width, pixels.size(), pixels.data());
        for (int column = columns.first; column <= columns.last; ++column) {
            if (!pixels[column].ended) {
                throw std::logic_error("rows were asked for behind the kept ones of a tile that "
                                       "has live pixels");
            }
            job_.path->write_pixel(tile.canvas, row, column, pixels[column]);
        }
    }
}

void KeptDrawing::draw_sheet(Tile& tile, DrawnSheet& sheet) {
    if (tile.canvas == kNone) {
        end_canvas(tile);
    }
    sheet.draw(job_, tile.job, tile.made, options_, canvases_, tile.canvas);
    if (!tile.is_kept() && tile.sheets_after_end < DrawnSheet::kSheetsAfterEnd) {
        tile.live -= sheet.ended_pixels();
        tile.sheets_after_end += tile.live == 0 ? 1 : 0;
        tile.writer.add(sheet, DrawnSheet::splats_of(tile.job, tile.made));
    }
}

void KeptDrawing::make_sheet(Tile& tile) {
    std::unique_ptr<DrawnSheet> sheet;
    if (free_sheets_.empty()) {
        sheet = std::make_unique<DrawnSheet>();
    } else {
        sheet = std::move(free_sheets_.back());
        free_sheets_.pop_back();
        sheet->drawn.clear();
    }
    const std::uint32_t splats = DrawnSheet::splats_of(tile.job, tile.made);
    if (tile.made < tile.kept.sheets()) {
        tile.kept.read(tile.made, splats, *sheet);
    } else {
        draw_sheet(tile, *sheet);
    }
    sheet->takes = splats * options_.modules;
    tile.sheets[tile.made++] = std::move(sheet);
}

DrawnSheet& KeptDrawing::sheet(Tile& tile, std::uint32_t place) {
    const std::uint32_t index = place / DrawnSheet::kSplats;
    while (tile.made <= index) {
        make_sheet(tile);
    }
    return *tile.sheets[index];
}

PixelRange KeptDrawing::rows(TileNumber number, std::uint32_t place) {
    return sheet(tile(number), place).splats[place % DrawnSheet::kSplats].rows;
}

void KeptDrawing::take(TileNumber number, std::uint32_t place, const PixelRange& own, int step,
                       DrawnRow* drawn) {
    Tile& from = tile(number);
    DrawnSheet& taken = sheet(from, place);
    taken.copy(place, own, step, drawn);
    for (int row = own.first; row <= own.last; row += step, ++drawn) {
        count(*drawn);
    }
    if (--taken.takes == 0) {
        free_sheets_.push_back(std::move(from.sheets[place / DrawnSheet::kSplats]));
    }
}

void KeptDrawing::read_row(TileNumber number, int row, int count, PixelValue* pixels) {
    const Tile& from = tile(number);
    if (from.is_kept()) {
        from.kept.read_pixels(std::size_t{1} * row * from.job.width, count, pixels);
    } else {
        canvases_.read_row(from.canvas, row, count, pixels);
    }
}

// Nothing of the tile will be taken any more, and its pixels are still there. A little more than
// was taken is kept, because another design may hear later of its last pixel's end.
void KeptDrawing::keep_pixels(Tile& tile) {
    while (tile.live == 0 && tile.sheets_after_end < DrawnSheet::kSheetsAfterEnd &&
           tile.made < tile.sheets.size()) {
        make_sheet(tile);
    }
    tile.pixels.resize(std::size_t{1} * tile.job.width * tile.job.height);
    for (int row = 0; row < tile.job.height; ++row) {
        canvases_.read_row(tile.canvas, row, tile.job.width,
                           &tile.pixels[std::size_t{1} * row * tile.job.width]);
    }
}

void KeptDrawing::clear_row(TileNumber number, int row) {
    Tile& done = tile(number);
    const bool keeps = !done.is_kept() && !name_.empty();
    if (keeps && done.cleared == 0) {
        keep_pixels(done);
    }
    if (done.canvas != kNone) {
        canvases_.clear_row(done.canvas, row);
    }
    if (++done.cleared != job_.tile_size) {
        return;
    }
    if (keeps && (done.live == 0 || done.made == done.sheets.size())) {
        kept_.put(key(done.job), done.writer.bytes(done.pixels));
    }
    if (done.canvas != kNone) {
        canvases_.close(done.canvas);
    }
    tiles_[number] = nullptr;
    tiles_.drop_before(std::min(job_.tiles.first(), tiles_.size()));
}

} // namespace degs
