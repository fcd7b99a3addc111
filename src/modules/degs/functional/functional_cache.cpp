// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/functional/functional_cache.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace degs {
namespace {

// A short key for a long text: the address at which the store keeps it, which is the same for all
// simulations that share the store. Empty if the store has no room.
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

FunctionalCache::FunctionalCache(RenderJob& job, const FunctionalOptions& options,
                                 const std::string& pixels, SharedBytes& kept)
    : job_(job), options_(options), kept_(kept),
      name_(short_name(kept, pixels + (options.tests ? "tests " : "") +
                                 std::to_string(static_cast<int>(options.rows)) + " " +
                                 std::to_string(job.tile_size))),
      contexts_(job, options.tests) {}

std::string FunctionalCache::key(const JobTile& tile) const {
    std::string key = name_;
    append(key, tile.frame);
    append(key, tile.x);
    append(key, tile.y);
    return key;
}

FunctionalCache::Tile& FunctionalCache::tile(TileNumber number) {
    while (number >= tiles_.size()) {
        tiles_.emplace_back();
    }
    std::unique_ptr<Tile>& place = tiles_[number];
    if (place == nullptr) {
        place = std::make_unique<Tile>();
        place->job = job_.tiles[number];
        place->live = place->job.pixels();
        place->batches.resize(RowBatch::batches_of(place->job));
        if (!name_.empty()) {
            place->kept = TileTraceReader(kept_.find(key(place->job)));
        }
        if (!place->is_kept()) {
            place->context = contexts_.open();
        }
    }
    return *place;
}

// Opens a context that has the pixels of a kept tile as they were after the last batch of its
// trace. All pixels in the image have ended by then, or nobody would ask for more rows.
void FunctionalCache::restore_context(Tile& tile) {
    tile.context = contexts_.open();
    std::vector<PixelValue> pixels(tile.job.width);
    const PixelRange rows = tile.job.image_rows(), columns = tile.job.image_columns();
    for (int row = rows.first; row <= rows.last; ++row) {
        tile.kept.read_pixels(std::size_t{1} * row * tile.job.width, pixels.size(), pixels.data());
        for (int column = columns.first; column <= columns.last; ++column) {
            if (!pixels[column].ended) {
                throw std::logic_error("rows were asked for behind the kept ones of a tile that "
                                       "has live pixels");
            }
            job_.path->write_pixel(tile.context, row, column, pixels[column]);
        }
    }
}

void FunctionalCache::rasterise_batch(Tile& tile, RowBatch& batch) {
    if (tile.context == kNone) {
        restore_context(tile);
    }
    batch.rasterise(job_, tile.job, tile.made, options_, contexts_, tile.context);
    if (!tile.is_kept() && tile.batches_after_end < RowBatch::kBatchesAfterEnd) {
        tile.live -= batch.ended_pixels();
        tile.batches_after_end += tile.live == 0 ? 1 : 0;
        tile.writer.add(batch, RowBatch::splats_of(tile.job, tile.made));
    }
}

void FunctionalCache::make_batch(Tile& tile) {
    std::unique_ptr<RowBatch> batch;
    if (free_batches_.empty()) {
        batch = std::make_unique<RowBatch>();
    } else {
        batch = std::move(free_batches_.back());
        free_batches_.pop_back();
        batch->outcomes.clear();
    }
    const std::uint32_t splats = RowBatch::splats_of(tile.job, tile.made);
    if (tile.made < tile.kept.batches()) {
        tile.kept.read(tile.made, splats, *batch);
    } else {
        rasterise_batch(tile, *batch);
    }
    batch->takes = splats * options_.modules;
    tile.batches[tile.made++] = std::move(batch);
}

RowBatch& FunctionalCache::batch(Tile& tile, std::uint32_t place) {
    const std::uint32_t index = place / RowBatch::kSplats;
    while (tile.made <= index) {
        make_batch(tile);
    }
    return *tile.batches[index];
}

PixelRange FunctionalCache::rows(TileNumber number, std::uint32_t place) {
    return batch(tile(number), place).splats[place % RowBatch::kSplats].rows;
}

void FunctionalCache::take(TileNumber number, std::uint32_t place, const PixelRange& own, int step,
                           RowOutcome* outcomes) {
    Tile& from = tile(number);
    RowBatch& taken = batch(from, place);
    taken.copy(place, own, step, outcomes);
    for (int row = own.first; row <= own.last; row += step, ++outcomes) {
        count(*outcomes);
    }
    if (--taken.takes == 0) {
        free_batches_.push_back(std::move(from.batches[place / RowBatch::kSplats]));
    }
}

void FunctionalCache::read_row(TileNumber number, int row, int count, PixelValue* pixels) {
    const Tile& from = tile(number);
    if (from.is_kept()) {
        from.kept.read_pixels(std::size_t{1} * row * from.job.width, count, pixels);
    } else {
        contexts_.read_row(from.context, row, count, pixels);
    }
}

// Completes the trace before the first row of pixels is cleared. It goes a little further than the
// rows that were taken here, because another design may hear later of the last pixel's end.
void FunctionalCache::keep_pixels(Tile& tile) {
    while (tile.live == 0 && tile.batches_after_end < RowBatch::kBatchesAfterEnd &&
           tile.made < tile.batches.size()) {
        make_batch(tile);
    }
    tile.pixels.resize(std::size_t{1} * tile.job.width * tile.job.height);
    for (int row = 0; row < tile.job.height; ++row) {
        contexts_.read_row(tile.context, row, tile.job.width,
                           &tile.pixels[std::size_t{1} * row * tile.job.width]);
    }
}

void FunctionalCache::clear_row(TileNumber number, int row) {
    Tile& done = tile(number);
    const bool keeps = !done.is_kept() && !name_.empty();
    if (keeps && done.cleared == 0) {
        keep_pixels(done);
    }
    if (done.context != kNone) {
        contexts_.clear_row(done.context, row);
    }
    if (++done.cleared != job_.tile_size) {
        return;
    }
    if (keeps && (done.live == 0 || done.made == done.batches.size())) {
        kept_.put(key(done.job), done.writer.bytes(done.pixels));
    }
    if (done.context != kNone) {
        contexts_.close(done.context);
    }
    tiles_[number] = nullptr;
    tiles_.drop_before(std::min(job_.tiles.first(), tiles_.size()));
}

} // namespace degs
