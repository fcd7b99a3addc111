// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "modules/kit/job/messages.hpp"
#include "splat/frame/pixel_mask.hpp"

namespace degs {

/// Cuts row spans at the fixed strides of their tile, columns 0 .. length - 1 and so on (paper,
/// Sec. IV-B), and numbers the conflict domains (row x segment) of one bank's rows of a tile. It
/// has no process: the Issue Bank asks for one segment after the other.
class Segmenter {
public:
    struct Domain {
        int row, column; ///< inside the tile; the column is that of its first pixel
    };
    /// The segment of a row that a pixel lies in.
    struct Place {
        std::int16_t segment = 0, column = 0; ///< its number, and the column of its first pixel
    };

    /// For bank `index` of `banks`, which owns every row y with y mod banks = index.
    Segmenter(int tile_size, int length, int index, int banks)
        : length_(length), full_(std::uint64_t{1} << length) {
        const int per_row = (tile_size + length - 1) / length;
        for (int i = 0; i < tile_size; ++i) {
            first_domain_of_row_.push_back(i / banks * per_row);
            place_of_column_.push_back({inside_tile(i / length), inside_tile(i / length * length)});
        }
        for (int row = index; row < tile_size; row += banks) {
            for (int s = 0; s < per_row; ++s) {
                domains_.push_back({row, s * length});
            }
        }
    }

    /// Upper bound of the domains that any bank has in a tile.
    static int domains_per_tile(int tile_size, int length, int banks) {
        return (tile_size + banks - 1) / banks * ((tile_size + length - 1) / length);
    }
    const std::vector<Domain>& domains() const { return domains_; }
    int domain_of(int row, int column) const {
        return first_domain_of(row) + place_of(column).segment;
    }
    int first_domain_of(int row) const { return first_domain_of_row_.data()[row]; }
    Place place_of(int column) const { return place_of_column_.data()[column]; }

    /// Begins with a span; the end of a tile is not one. `context` of the Pixel Buffer holds its
    /// tile.
    void start(const SpanItem& item, std::int16_t context) {
        const RowSpan& span = *item.span;
        const Place place = place_of(span.x0);
        column_ = place.column;
        domain_ = first_domain_of(span.y) + place.segment;
        low_ = std::uint64_t{1} << (span.x0 - column_);
        left_ = span.x0 + span.length - column_;
        base_ = span.base;
        g0_ = span.g0;
        d0_ = span.d0;
        splat_ = span.splat;
        drawn_ = item.drawn;
        row_ = span.y;
        tile_ = item.tile;
        context_ = context;
    }
    /// True if a segment of the span is left.
    bool cutting() const { return left_ > 0; }
    TileNumber tile() const { return tile_; }
    /// Domain of the next segment.
    int domain() const { return domain_; }
    std::uint32_t mask() const {
        const std::uint64_t high = left_ < length_ ? std::uint64_t{1} << left_ : full_;
        return static_cast<std::uint32_t>(high - low_);
    }
    /// What becomes of the tasks of the next segment, if they are drawn.
    void fill(DrawnTasks& drawn) const {
        drawn.inside = drawn_.inside.from(column_);
        drawn.useful = drawn_.useful.from(column_);
        drawn.ended = drawn_.ended.from(column_);
    }
    /// Puts the tasks `mask` of the next segment together. It writes field by field, because a copy
    /// of data that was just written would wait for the write.
    void fill(TaskRun& run, std::uint32_t mask) const {
        run.tile = tile_;
        run.domain = domain_;
        run.task.splat = splat_;
        run.task.mask = mask;
        run.task.row = row_;
        run.task.column = inside_tile(column_);
        run.task.context = context_;
    }
    /// What the PEs need to compute them, unless they are drawn.
    void fill(BlendTask& task) const {
        task.g0 = g0_;
        task.d0 = d0_;
        task.offset = inside_tile(column_ - base_);
    }
    void next() {
        column_ += length_;
        left_ -= length_;
        low_ = 1;
        ++domain_;
    }

private:
    int length_;
    std::uint64_t full_; // the bit behind a segment
    // Tables replace divisions in the hot loop.
    std::vector<Domain> domains_;
    std::vector<int> first_domain_of_row_;
    std::vector<Place> place_of_column_;
    // The span being cut, in pixels of the tile, and its next segment.
    TileNumber tile_ = kNoTile;
    std::uint32_t splat_ = 0;
    double g0_ = 0, d0_ = 0;
    DrawnRow drawn_;
    int base_ = 0, column_ = 0, domain_ = 0;
    int left_ = 0;          // columns from column_ to the end of the span
    std::uint64_t low_ = 1; // bit of the segment's first pixel
    std::int16_t row_ = 0, context_ = 0;
};

} // namespace degs
