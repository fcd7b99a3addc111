// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/coarse_tile.hpp"

#include <algorithm>
#include <cmath>

namespace degs {
namespace {

/// Entries between the splat that is solved and the one that is asked for: lists visit splats in no
/// order of memory.
constexpr std::uint64_t kPrefetched = 6;

} // namespace

CoarseTile::CoarseTile(const FrameWorkload& frame, const Options& options)
    : frame_(frame), options_(options),
      cells_x_((frame.tile_size + options.cell_width - 1) / options.cell_width),
      samples_((frame.tile_size + kApart * kLanes - 1) / (kApart * kLanes) * kLanes),
      grid_(frame.grid()), prepared_(kPrepared) {}

void CoarseTile::begin(int tile, const RowChoice& choice) {
    const PixelBox whole = grid_.pixels_of(tile), inside = grid_.image_pixels_of(tile);
    tile_ = tile;
    x_ = whole.x0;
    y_ = whole.y0;
    columns_ = PixelRange{inside.x0, inside.x1}.relative_to(x_);
    pixel_rows_ = PixelRange{inside.y0, inside.y1}.relative_to(y_);
    begin_ = entry_ = frame_.tile_begin[tile];
    end_ = frame_.tile_begin[tile + 1];
    blended_ = 0;
    choose_rows(choice);
    transmittance_.assign(rows_.size() * samples_, 1.0F);
    cells_.assign(cell_of(pixel_rows_.last, 0) + cells_x_, {});
    next_cell_end_ = kNever;
    ++cell_changes_;
    live_in_row_.assign(pixel_rows_.last + 1, 0);
    whole_ = {};
    for (const int row : rows_) {
        for (int column = phase_of(row); column <= columns_.last; column += kApart) {
            Cell& cell = cells_[cell_of(row, column)];
            cell.live = ++cell.samples;
            ++live_in_row_[row];
            whole_.live = ++whole_.samples;
        }
    }
}

void CoarseTile::choose_rows(const RowChoice& choice) {
    const PixelRange blocks{pixel_rows_.first / choice.height, pixel_rows_.last / choice.height};
    const int first = std::min(choice.first, blocks.size() - 1);
    blocks_.clear();
    rows_.clear();
    rows_from_.assign(pixel_rows_.first, 0);
    place_of_row_.assign(pixel_rows_.last + 1, 0);
    int height_of_blocks = 0;
    for (int block = blocks.first; block <= blocks.last; ++block) {
        const bool sampled = (block - blocks.first) % choice.apart == first % choice.apart;
        const int begin = std::max(block * choice.height, pixel_rows_.first);
        const int end = std::min((block + 1) * choice.height, pixel_rows_.last + 1);
        if (sampled) {
            blocks_.push_back(block);
            height_of_blocks += end - begin;
        }
        for (int row = begin; row < end; ++row) {
            rows_from_.push_back(static_cast<int>(rows_.size()));
            if (sampled && (row - begin) % choice.step == 0) {
                place_of_row_[row] = rows_.size() * samples_;
                rows_.push_back(row);
            }
        }
    }
    rows_from_.push_back(static_cast<int>(rows_.size()));
    row_values_.assign(rows_.begin(), rows_.end());
    row_values_.resize(rows_.size() + kLanes - 1);
    spans_.resize(rows_.size());
    row_weight_ = static_cast<double>(pixel_rows_.size()) / static_cast<double>(rows_.size());
    block_weight_ = static_cast<double>(pixel_rows_.size()) / height_of_blocks;
}

CoarseSpan CoarseTile::span_of(int row) const {
    CoarseSpan span;
    span.row = row;
    const float dy = static_cast<float>(row) - mu_y_;
    const float rest = threshold_ - dy * dy * inverse_c_;
    if (rest < 0) {
        return span;
    }
    const float centre = mu_x_ + slope_ * dy;
    const float reach = std::sqrt(rest * det_over_c_);
    float left = std::ceil(centre - reach), right = std::floor(centre + reach);
    if (options_.outward) {
        left = std::floor(centre - reach) - static_cast<float>(options_.delta);
        right = std::ceil(centre + reach) + static_cast<float>(options_.delta);
    }
    left = std::max(left, static_cast<float>(columns_.first));
    right = std::min(right, static_cast<float>(columns_.last));
    if (left <= right) {
        span.first = static_cast<int>(left);
        span.last = static_cast<int>(right);
    }
    return span;
}

bool CoarseTile::next() {
    if (entry_ == end_ || (whole_.live == 0 && entry_ >= whole_.end)) {
        return false;
    }
    splat_ = frame_.tile_splats[entry_++];
    if (entry_ > next_cell_end_) {
        pass_cells();
    }
    if (entry_ + kPrefetched < end_) {
        const auto* const ahead = &frame_.splats[frame_.tile_splats[entry_ + kPrefetched]];
        __builtin_prefetch(ahead); // what is needed of it lies in two lines of the host's cache
        __builtin_prefetch(&ahead->q_threshold);
    }
    const Prepared& s = prepared(splat_);
    mu_x_ = static_cast<float>(s.mu_x - x_);
    mu_y_ = static_cast<float>(s.mu_y - y_);
    inverse_c_ = s.inverse_c;
    threshold_ = s.threshold;
    opacity_ = s.opacity;
    conic_a_ = s.conic_a;
    slope_ = s.slope;
    det_over_c_ = s.det_over_c;
    const auto least = static_cast<float>(pixel_rows_.first);
    const auto most = static_cast<float>(pixel_rows_.last);
    first_row_ = static_cast<int>(std::clamp(std::ceil(mu_y_ - s.reach), least, most + 1));
    last_row_ = static_cast<int>(std::clamp(std::floor(mu_y_ + s.reach), least - 1, most));
    solve_rows();
    return true;
}

const CoarseTile::Prepared& CoarseTile::prepared(std::uint32_t splat) {
    Prepared& place = prepared_[splat % kPrepared];
    if (place.splat != splat) {
        const ProjectedSplat& s = frame_.splats[splat];
        const double inverse_c = 1 / s.cov_c;
        place = {splat,
                 static_cast<float>(inverse_c),
                 static_cast<float>(s.q_end()),
                 static_cast<float>(s.opacity),
                 static_cast<float>(s.conic_a()),
                 static_cast<float>(s.cov_b * inverse_c),
                 static_cast<float>(s.det * inverse_c),
                 std::sqrt(static_cast<float>(s.q_end() * s.cov_c)),
                 s.mu_x,
                 s.mu_y};
    }
    return place;
}

CoarseTile::Samples CoarseTile::samples_in(const CoarseSpan& span) const {
    const int phase = phase_of(span.row);
    // Division of what may be negative: a tile further left keeps it positive.
    return {(span.first - phase + kApart - 1 + kApart) / kApart - 1,
            (span.last - phase + kApart) / kApart - 1};
}

double CoarseTile::live_share(const CoarseSpan& span) const {
    Samples in = samples_in(span);
    if (in.last < in.first) { // the nearest one
        const int most = (columns_.last - phase_of(span.row) + kApart) / kApart - 1;
        in.first = in.last = std::clamp(in.first, 0, std::max(most, 0));
    }
    const float* row = transmittance_.data() + place_of_row_[span.row];
    int live = 0;
    for (int i = in.first; i <= in.last; ++i) {
        live += row[i] > 0 ? 1 : 0;
    }
    return static_cast<double>(live) / (in.last - in.first + 1);
}

void CoarseTile::end_sample(int row, int column) {
    --live_in_row_[row];
    const int width = columns_.size(), height = pixel_rows_.size();
    end_sample(whole_, width, height);
    Cell& cell = cells_[cell_of(row, column)];
    end_sample(cell, std::min(options_.cell_width, width), std::min(options_.cell_height, height));
    if (cell.live == 0) {
        ++cell_changes_;
        if (cell.end >= entry_) {
            next_cell_end_ = std::min(next_cell_end_, cell.end);
        }
    }
}

// All pixels of some cells have ended with the entry before.
void CoarseTile::pass_cells() {
    ++cell_changes_;
    next_cell_end_ = kNever;
    for (const Cell& cell : cells_) {
        if (cell.live == 0 && cell.end >= entry_) {
            next_cell_end_ = std::min(next_cell_end_, cell.end);
        }
    }
}

/// If pixels end evenly later across a block of so many, in some direction, the last of them ends
/// after the last sample by as much as the samples end one after the other over that distance: half
/// the gap between samples, less a pixel, in either direction.
void CoarseTile::end_sample(Cell& cell, int width, int height) const {
    if (cell.live-- == cell.samples) {
        cell.first_end = entry_;
    }
    if (cell.live != 0) {
        return;
    }
    const double columns = std::max(1.0, 1.0 * width / kApart);
    const double rows = std::max(1.0, cell.samples / columns);
    const double gap_x = width / columns, gap_y = std::max(1.0, height / rows);
    const double sampled = std::max(0.0, width - gap_x) + std::max(0.0, height - gap_y);
    const double beyond = (gap_x - 1 + gap_y - 1) / 2;
    const double range = static_cast<double>(entry_ - cell.first_end);
    const auto more = sampled == 0 ? 0 : std::llround(range * beyond / sampled);
    cell.end = more == 0 ? 0 : entry_ + more;
}

EntrySizes entry_sizes(const FrameWorkload& frame, int step) {
    constexpr std::size_t kSkip = 16;
    constexpr double kPixelsPerVisit = 16; // one in four is blended
    const double side = frame.tile_size;
    double rows = 0, visits = 0, entries = 0;
    for (std::size_t s = 0; s < frame.splats.size(); s += kSkip) {
        const ProjectedSplat& splat = frame.splats[s];
        const double height = std::min(2 * std::sqrt(splat.q_threshold * splat.cov_c), side);
        const double width = std::min(2 * std::sqrt(splat.q_threshold * splat.cov_a), side);
        const double tiles = frame.tiles_touched[s];
        rows += tiles * height / step;
        visits += tiles * height / step * (1 + width / kPixelsPerVisit);
        entries += tiles;
    }
    return entries == 0 ? EntrySizes() : EntrySizes{rows / entries, visits / entries};
}

} // namespace degs
