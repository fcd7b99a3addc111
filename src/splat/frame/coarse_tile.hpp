// SPDX-License-Identifier: Apache-2.0
// A tile whose splats are rendered at a sample of its pixels: exact spans, sampled transmittance.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "splat/frame/frame_workload.hpp"
#include "splat/frame/pixel_index.hpp"

namespace degs {

/// Some rows of a tile: of its blocks of `height` rows every `apart`-th one, from `first` on, and
/// in these every `step`-th row.
struct RowChoice {
    int height = 1, apart = 1, first = 0, step = 1;
};

/// Pixels of a row, px from the left border of the tile.
struct CoarseSpan {
    int row = 0; ///< of the tile
    int first = 0, last = -1;
    int length() const { return last - first + 1; }
};

/// Spans that lie one behind the other in an array.
struct CoarseSpans {
    const CoarseSpan *first = nullptr, *last = nullptr; ///< behind the last one
    const CoarseSpan* begin() const { return first; }
    const CoarseSpan* end() const { return last; }
    std::size_t size() const { return static_cast<std::size_t>(last - first); }
    const CoarseSpan& front() const { return *first; }
};

/// Renders a sample of the rows of a tile splat by splat, near to far, by the rules of the
/// reference renderer in single precision, at one column in four. What ends is known per cell, a
/// block of pixels.
class CoarseTile {
public:
    static constexpr int kLanes = 4; ///< rows or samples that the host takes at a time

    struct Options {
        int cell_width = 1, cell_height = 1; ///< px, from the upper left corner of a tile
        bool outward = false; ///< spans end at the first pixels outside the ellipse, or on it
        int delta = 0;        ///< px more than that at both ends
    };
    CoarseTile(const FrameWorkload& frame, const Options& options);

    /// Begins a tile. At least one of its rows is sampled, whatever the choice.
    void begin(int tile, const RowChoice& choice);
    /// Solves the next splat of the list. False if the list is over or all sampled pixels have
    /// ended.
    bool next();
    /// Blends the solved splat.
    void blend();

    // Number, place and size of the tile, and its list.
    int tile() const { return tile_; }
    int x() const { return x_; } ///< of its corner, raster px
    int y() const { return y_; }
    const PixelRange& columns() const { return columns_; } ///< of the tile, inside the image
    const PixelRange& pixel_rows() const { return pixel_rows_; }
    double pixels() const { return 1.0 * columns_.size() * pixel_rows_.size(); }
    double entries() const { return static_cast<double>(end_ - begin_); }
    double walked() const { return static_cast<double>(entry_ - begin_); } ///< solved so far
    /// Sampling weights: the number of rows that a sampled row stands for, and the number of blocks
    /// that a block with sampled rows stands for.
    double row_weight() const { return row_weight_; }
    double block_weight() const { return block_weight_; }
    /// The sampled rows, and the blocks that they make up; top to bottom.
    const std::vector<int>& rows() const { return rows_; }
    const std::vector<int>& blocks() const { return blocks_; }

    // The solved splat, its rows and its spans.
    std::uint32_t splat() const { return splat_; }
    /// Rows of the tile that the splat's bounding box meets, sampled or not.
    int first_row() const { return first_row_; }
    int last_row() const { return last_row_; }
    /// The sampled rows among them, as a range of rows().
    int first_sampled() const { return rows_from_[first_row_]; }
    int end_sampled() const { return rows_from_[std::max(last_row_ + 1, first_row_)]; }
    /// The spans of the sampled rows that the splat covers, top to bottom.
    CoarseSpans spans() const { return {spans_.data(), spans_.data() + span_count_}; }
    /// The span of any row of the image, px from the upper left corner of the tile; empty without a
    /// pixel inside the tile's columns.
    CoarseSpan span_of(int row) const;

    /// False once all sampled pixels of a sampled row have ended.
    bool row_is_live(int row) const { return live_in_row_[row] != 0; }
    /// Share of the sampled pixels of the span that have not ended.
    double live_share(const CoarseSpan& span) const;
    /// False once all pixels of the cell that holds the pixel are expected to have ended.
    bool cell_is_live(int row, int column) const {
        const Cell& cell = cells_[cell_of(row, column)];
        return cell.live != 0 || entry_ <= cell.end;
    }

    /// Changes when a cell may have ended since, and with another tile.
    std::uint64_t cell_changes() const { return cell_changes_; }

    /// Fragments so far, scaled to all pixels.
    double fragments() const { return static_cast<double>(blended_) * kApart * row_weight_; }

private:
    static constexpr int kApart = 4; ///< px between sampled columns
    static constexpr std::uint64_t kNever = ~std::uint64_t{0};
    /// Neighbouring tiles list the same splats: so many are kept.
    static constexpr std::size_t kPrepared = 1024;
    /// Neighbouring rows have their columns apart; every row has one.
    int phase_of(int row) const {
        return columns_.first + row * 3 % std::min(kApart, columns_.size());
    }
    /// What all tiles need of a splat.
    struct Prepared {
        std::uint32_t splat = ~0U;
        float inverse_c = 0, threshold = 0, opacity = 0, conic_a = 0, slope = 0, det_over_c = 0;
        float reach = 0; ///< rows from the mean to the end of the bounding box
        double mu_x = 0, mu_y = 0;
    };
    const Prepared& prepared(std::uint32_t splat);
    void solve_rows();
    void pass_cells();
    struct Samples {
        int first, last;
    };
    struct Cell {
        int samples = 0, live = 0;   ///< sampled pixels, and those that have not ended
        std::uint64_t first_end = 0; ///< entries until the first of them had ended
        std::uint64_t end = 0;       ///< the last one before all pixels have; 0: already
    };
    void end_sample(int row, int column);
    void end_sample(Cell& cell, int width, int height) const;
    std::size_t cell_of(int row, int column) const {
        return row / options_.cell_height * cells_x_ + column / options_.cell_width;
    }
    Samples samples_in(const CoarseSpan& span) const;
    void choose_rows(const RowChoice& choice);
    float* transmittance_of(int row) { return transmittance_.data() + place_of_row_[row]; }

    const FrameWorkload& frame_;
    Options options_;
    int cells_x_, samples_; ///< cells and places for samples per row
    TileGrid grid_;
    int tile_ = 0, x_ = 0, y_ = 0;
    PixelRange columns_, pixel_rows_;
    double row_weight_ = 1, block_weight_ = 1;
    std::vector<int> blocks_;
    std::vector<int> rows_;                 ///< sampled rows, rising
    std::vector<float> row_values_;         ///< the same, and behind them whatever
    std::vector<int> rows_from_;            ///< by row: how many of rows_ are above it
    std::vector<std::size_t> place_of_row_; ///< in transmittance_, if the row is sampled
    std::uint64_t begin_ = 0, end_ = 0, entry_ = 0;
    std::vector<float> transmittance_; ///< of the sampled pixels; 0: ended
    std::vector<Cell> cells_;
    std::vector<int> live_in_row_;
    Cell whole_; ///< the tile
    std::uint64_t blended_ = 0;
    std::uint64_t cell_changes_ = 0;
    std::uint64_t next_cell_end_ = kNever; ///< of cells without a live sample
    std::vector<Prepared> prepared_;       ///< by number modulo their count

    std::uint32_t splat_ = 0;
    float mu_x_ = 0, mu_y_ = 0; ///< px from the tile
    float conic_a_ = 0, slope_ = 0, inverse_c_ = 0, det_over_c_ = 0, threshold_ = 0, opacity_ = 0;
    int first_row_ = 0, last_row_ = -1;
    std::vector<CoarseSpan> spans_; ///< the first span_count_ count
    std::size_t span_count_ = 0;
};

/// Sizes of an entry of a tile's list, as means over all lists of a frame.
struct EntrySizes {
    double rows = 0;   ///< of a splat on a tile
    double visits = 0; ///< what it costs to render all of these rows, in visits
};
/// The sizes of the entries of a frame, where every `step`-th row is sampled.
EntrySizes entry_sizes(const FrameWorkload& frame, int step);

} // namespace degs
