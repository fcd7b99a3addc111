// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "modules/kit/job/messages.hpp"
#include "splat/frame/pixel_index.hpp"

namespace degs {

/// A tile that lists at least one splat. Empty tiles never enter the pipeline.
struct JobTile {
    std::uint32_t frame = 0;
    int x = 0, y = 0;          ///< top left pixel in the raster, see Camera
    int width = 0, height = 0; ///< pixels inside the raster
    /// How many of its first and last columns and rows are not in the image.
    int cut_left = 0, cut_top = 0, cut_right = 0, cut_bottom = 0;
    std::uint64_t first = 0; ///< into the frame's tile_splats
    std::uint64_t count = 0;
    const std::uint32_t* list = nullptr; ///< indices of its splats, near to far, in the frame
    std::uint32_t first_splat = 0;       ///< DataPath index of the frame's splat 0
    std::uint64_t before = 0;            ///< entries of the frame's tiles that are taken earlier
    TileNumber turn = 0;                 ///< tiles of its frame before it; TileList counts them
    bool last_of_frame = false;
    bool passed = false; ///< sorted and fetched; its list is not asked for again

    // The part inside the image, which is the one that is rendered. The list and the numbers of
    // rows are those of the whole tile.
    PixelRange columns() const { return image_columns().relative_to(-x); } ///< of the raster
    PixelRange rows() const { return image_rows().relative_to(-y); }       ///< of the raster
    PixelRange image_columns() const { return {cut_left, width - 1 - cut_right}; } ///< of the tile
    PixelRange image_rows() const { return {cut_top, height - 1 - cut_bottom}; }   ///< of the tile
    std::int64_t pixels() const {
        return std::int64_t{1} * image_columns().size() * image_rows().size();
    }
    /// The splat at a place of its list, as the data path counts it.
    std::uint32_t splat(std::uint32_t place) const { return first_splat + list[place]; }
};

/// Tiles that keep their place when others join or the oldest retire, so that blocks may hold on to
/// one.
class TileList {
public:
    /// The number of the next tile.
    std::size_t size() const { return size_; }
    /// The lowest number that has not retired.
    std::size_t first() const { return first_; }
    bool empty() const { return size_ == 0; }
    /// Entries of the lists of all tiles that have joined, and pixels of these inside the image.
    std::uint64_t entries() const { return entries_; }
    std::uint64_t pixels() const { return pixels_; }
    JobTile& operator[](std::size_t number) { return *index_[number - first_]; }
    const JobTile& operator[](std::size_t number) const { return *index_[number - first_]; }
    JobTile& back() { return *index_.back(); }
    void push_back(const JobTile& tile) {
        const bool first = tiles_.empty() || tiles_.back().frame != tile.frame;
        const TileNumber turn = first ? 0 : tiles_.back().turn + 1;
        tiles_.push_back(tile);
        tiles_.back().turn = turn;
        index_.push_back(&tiles_.back());
        size_ = first_ + index_.size();
        entries_ += tile.count;
        pixels_ += tile.pixels();
    }
    /// Retires the tiles of a frame, which must be the oldest. False, and nothing happens, if one
    /// of them has not been passed.
    bool retire(std::uint32_t frame);
    /// The iterators go over the tiles that have not retired.
    std::deque<JobTile>::const_iterator begin() const { return tiles_.begin(); }
    std::deque<JobTile>::const_iterator end() const { return tiles_.end(); }

private:
    std::deque<JobTile> tiles_;
    std::vector<JobTile*> index_; // for the hot loops; a deque would have to divide
    std::size_t first_ = 0;       // tiles that have retired
    std::size_t size_ = 0;        // of tiles_ and those, for the hot loops
    std::uint64_t entries_ = 0, pixels_ = 0;
};

} // namespace degs
