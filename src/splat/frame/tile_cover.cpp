// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/tile_cover.hpp"

#include <algorithm>
#include <cmath>

#include "splat/frame/pixel_index.hpp"

namespace degs {
namespace {

/// The columns of an ellipse on one pixel row at a time.
class RowSolver {
public:
    RowSolver(const ProjectedSplat& splat, const PixelBox& bounds)
        : mu_x_(splat.mu_x), mu_y_(splat.mu_y), q_end_(splat.q_end()),
          slope_(splat.cov_b / splat.cov_c), inverse_c_(1.0 / splat.cov_c),
          det_over_c_(splat.det / splat.cov_c), first_(bounds.x0), last_(bounds.x1) {}

    /// Moving down, the centre moves to the right (or stays).
    bool leans_right() const { return slope_ >= 0; }

    /// The pixels of row y inside the ellipse, clipped to the bounds.
    PixelRange solve(int y) const {
        const double dy = y - mu_y_;
        const double centre = mu_x_ + slope_ * dy;
        const double rest = std::max(0.0, q_end_ - dy * dy * inverse_c_);
        const double half = std::sqrt(det_over_c_ * rest);
        const double wide = half + pixel_slack(std::abs(centre) + std::abs(mu_x_));
        const double low = std::max(first_, std::ceil(centre - wide));
        const double high = std::min(last_, std::floor(centre + wide));
        if (!(low <= high)) {
            return {};
        }
        return {static_cast<int>(low), static_cast<int>(high)};
    }

private:
    double mu_x_, mu_y_, q_end_, slope_, inverse_c_, det_over_c_;
    double first_, last_; ///< columns of the bounds
};

/// Collects the tiles of consecutive pixel rows of one tile row. Rows arrive such that the centre
/// of the ellipse moves to the right; by convexity a row can then never reach back across a gap, so
/// one open run is enough. Gaps occur where a thin flat ellipse passes between pixel centres.
class RunCollector {
public:
    /// `leftmost` .. `rightmost`: tiles of the bounding box.
    RunCollector(int row, int leftmost, int rightmost, std::vector<TileRun>& runs)
        : row_(row), leftmost_(leftmost), rightmost_(rightmost), runs_(runs) {}

    void add(int first, int last) {
        first = std::max(first, barrier_);
        if (last < first) {
            return;
        }
        if (last_ >= 0 && first > last_ + 1) {
            close();
        }
        first_ = last_ < 0 ? first : std::min(first_, first);
        last_ = std::max(last_, last);
    }
    void close() {
        if (last_ >= 0) {
            runs_.push_back({row_, first_, last_});
            barrier_ = last_ + 1; // rounding must not list a tile twice
            last_ = -1;
        }
    }
    /// No further row can add a tile.
    bool complete() const { return first_ <= leftmost_ && last_ >= rightmost_; }

private:
    int row_, leftmost_, rightmost_;
    std::vector<TileRun>& runs_;
    int first_ = 0, last_ = -1, barrier_ = 0;
};

/// Feeds the pixel rows top .. bottom of one row of tiles to the collector.
void cover_tile_row(const RowSolver& solver, const TileGrid& grid, int top, int bottom,
                    RunCollector& collector) {
    const int size = grid.tile_size(), from = grid.first_column();
    const int step = solver.leans_right() ? 1 : -1;
    int y = step > 0 ? top : bottom;
    for (int left = bottom - top; left >= 0 && !collector.complete(); --left, y += step) {
        const PixelRange columns = solver.solve(y);
        if (!columns.empty()) {
            collector.add(columns.first / size - from, columns.last / size - from);
        }
    }
    collector.close();
}

/// Takes hidden tiles out of the runs.
void drop_hidden(const PixelBox& hidden, std::vector<TileRun>& runs) {
    if (hidden.empty()) {
        return;
    }
    std::vector<TileRun> shown;
    shown.reserve(runs.size() + 1);
    for (const TileRun& run : runs) {
        if (run.row < hidden.y0 || run.row > hidden.y1) {
            shown.push_back(run);
            continue;
        }
        const TileRun before{run.row, run.first, std::min(run.last, hidden.x0 - 1)};
        const TileRun behind{run.row, std::max(run.first, hidden.x1 + 1), run.last};
        for (const TileRun& part : {before, behind}) {
            if (part.first <= part.last) {
                shown.push_back(part);
            }
        }
    }
    runs.swap(shown);
}

/// int() truncates toward zero as in the original; clamped first, so that huge radii are safe.
/// Counted from the image's first tile.
int clamped_tile(double tile, int first, int tiles) {
    return index_within(tile, first, first + tiles) - first;
}

void cover_ellipse(const ProjectedSplat& splat, const TileGrid& grid, std::vector<TileRun>& runs) {
    const PixelBox box = pixel_box(splat, grid.covered());
    if (box.empty()) {
        return;
    }
    const int size = grid.tile_size(), from = grid.first_column();
    const RowSolver solver(splat, grid.covered());
    for (int row = box.y0 / size; row <= box.y1 / size; ++row) {
        const int top = std::max(box.y0, row * size);
        const int bottom = std::min(box.y1, row * size + size - 1);
        RunCollector collector(row - grid.first_row(), box.x0 / size - from, box.x1 / size - from,
                               runs);
        cover_tile_row(solver, grid, top, bottom, collector);
    }
}

void cover_pixel_box(const ProjectedSplat& splat, const TileGrid& grid,
                     std::vector<TileRun>& runs) {
    const PixelBox box = pixel_box(splat, grid.covered());
    if (box.empty()) {
        return;
    }
    const int size = grid.tile_size(), from = grid.first_column();
    for (int row = box.y0 / size; row <= box.y1 / size; ++row) {
        runs.push_back({row - grid.first_row(), box.x0 / size - from, box.x1 / size - from});
    }
}

/// Half widths of a box around the mean, px.
struct HalfWidths {
    double x = 0, y = 0;
};

HalfWidths square_of(const ProjectedSplat& splat) {
    const double mid = 0.5 * (splat.cov_a + splat.cov_c);
    const double half_difference = 0.5 * (splat.cov_a - splat.cov_c);
    // mid^2 - det without cancellation; the floor of 0.1 px^4 makes every radius at least 3 px.
    const double root = half_difference * half_difference + splat.cov_b * splat.cov_b;
    const double radius = std::ceil(3.0 * std::sqrt(mid + std::sqrt(std::max(0.1, root))));
    return {radius, radius};
}

HalfWidths box_of(const ProjectedSplat& splat) {
    return {std::ceil(3.0 * std::sqrt(splat.cov_a)), std::ceil(3.0 * std::sqrt(splat.cov_c))};
}

/// The tiles that the reference code finds for a box.
void cover_box(const ProjectedSplat& splat, const HalfWidths& half, const TileGrid& grid,
               std::vector<TileRun>& runs) {
    const double size = grid.tile_size();
    const auto column = [&](double x) {
        return clamped_tile(x / size, grid.first_column(), grid.tiles_x());
    };
    const auto row_of = [&](double y) {
        return clamped_tile(y / size, grid.first_row(), grid.tiles_y());
    };
    const int x0 = column(splat.mu_x - half.x);
    const int y0 = row_of(splat.mu_y - half.y);
    const int x1 = column(splat.mu_x + half.x + size - 1);
    const int y1 = row_of(splat.mu_y + half.y + size - 1);
    for (int row = y0; row < y1 && x0 < x1; ++row) {
        runs.push_back({row, x0, x1 - 1});
    }
}

} // namespace

const std::vector<const char*>& tile_mode_names() {
    static const std::vector<const char*> names{"exact", "square", "box", "tight"};
    return names;
}

const char* const kTileModesDoc =
    "tiles that list a splat; box: those of its axis-aligned 3-sigma box (paper, Sec. II-A); "
    "exact: those that the ellipse touches; tight: those of the box of the ellipse; square: those "
    "of the 3-sigma square of the reference code";

void cover_tiles(const ProjectedSplat& splat, const TileGrid& grid, TileMode mode,
                 std::vector<TileRun>& runs) {
    runs.clear();
    switch (mode) {
    case TileMode::Exact:
        cover_ellipse(splat, grid, runs);
        break;
    case TileMode::Square:
        cover_box(splat, square_of(splat), grid, runs);
        break;
    case TileMode::Box:
        cover_box(splat, box_of(splat), grid, runs);
        break;
    case TileMode::Tight:
        cover_pixel_box(splat, grid, runs);
        break;
    }
    drop_hidden(grid.hidden(), runs);
}

} // namespace degs
