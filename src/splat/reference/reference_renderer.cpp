// SPDX-License-Identifier: Apache-2.0
#include "splat/reference/reference_renderer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "splat/frame/pixel_rules.hpp"

namespace degs {
namespace {

/// Where alpha decides, pixels this far outside Q_th need no exponential; far above the rounding of
/// q.
constexpr double kQMargin = 1e-6;

struct Pixel {
    std::array<double, 3> rgb{};
    double transmittance = 1;
    std::uint32_t fragments = 0;
    bool done = false; ///< a splat was refused
};

/// The terms of a splat for the pixel loop. q = A (dx - (b/c) dy)^2 + dy^2 / c is the completed
/// square of the conic form: the same q, but a sum of non-negative terms that stays exact for
/// needles.
struct SplatTerms {
    double conic_a, slope, inverse_c, det_over_c, q_limit;
    explicit SplatTerms(const ProjectedSplat& s)
        : conic_a(s.conic_a()), slope(s.cov_b / s.cov_c), inverse_c(1.0 / s.cov_c),
          det_over_c(s.det / s.cov_c),
          q_limit(s.q_cut_off > 0 ? s.q_end() : s.q_threshold + kQMargin) {}
};

/// One tile at a time, in double precision.
class TilePainter {
public:
    explicit TilePainter(const FrameWorkload& work)
        : work_(work), grid_(work.grid()), stride_(clipped(work.tile_size, work.camera.width)),
          pixels_(stride_ * clipped(work.tile_size, work.camera.height)),
          live_in_row_(clipped(work.tile_size, work.camera.height)) {}

    void begin(int tile);
    bool finished() const { return live_ == 0; }
    void paint(const ProjectedSplat& splat);
    /// `left`, `top`: the image's first pixel in the raster.
    void write(Image& image, int left, int top, ReferenceCounts& counts) const;

private:
    static std::size_t clipped(int tile_size, int image) { return std::min(tile_size, image); }
    std::size_t row(int y) const { return (y - y0_) * stride_; }
    void paint_row(const ProjectedSplat& splat, const SplatTerms& terms, int y);
    /// Blends pixels first .. last of a row of the tile; returns how many of them stopped.
    int blend(const ProjectedSplat& splat, const SplatTerms& terms, double q_row, double centre,
              int first, int last, Pixel* row) const;

    const FrameWorkload& work_;
    TileGrid grid_;
    std::size_t stride_; ///< pixels per row of the tile
    std::vector<Pixel> pixels_;
    std::vector<int> live_in_row_; ///< pixels that are not done
    int live_ = 0;
    int x0_ = 0, y0_ = 0, x1_ = 0, y1_ = 0; ///< px, inclusive
};

void TilePainter::begin(int tile) {
    const PixelBox box = grid_.image_pixels_of(tile);
    x0_ = box.x0;
    y0_ = box.y0;
    x1_ = box.x1;
    y1_ = box.y1;
    std::fill(pixels_.begin(), pixels_.end(), Pixel{});
    std::fill(live_in_row_.begin(), live_in_row_.end(), x1_ - x0_ + 1);
    live_ = (x1_ - x0_ + 1) * (y1_ - y0_ + 1);
}

void TilePainter::paint(const ProjectedSplat& splat) {
    const SplatTerms terms(splat);
    // One pixel wider than the ellipse: the alpha test of each pixel decides.
    const double reach = std::sqrt(splat.q_threshold * splat.cov_c) + 1;
    const double top = std::max<double>(y0_, splat.mu_y - reach);
    const double bottom = std::min<double>(y1_, splat.mu_y + reach);
    if (!(top <= bottom)) {
        return;
    }
    for (int y = static_cast<int>(top); y <= static_cast<int>(bottom); ++y) {
        if (live_in_row_[y - y0_] > 0) {
            paint_row(splat, terms, y);
        }
    }
}

void TilePainter::paint_row(const ProjectedSplat& splat, const SplatTerms& terms, int y) {
    const double dy = y - splat.mu_y;
    const double centre = splat.mu_x + terms.slope * dy;
    const double q_row = dy * dy * terms.inverse_c;
    const double rest = std::max(0.0, splat.q_threshold - q_row);
    const double reach = std::sqrt(rest * terms.det_over_c) + 1;
    const double left = std::max<double>(x0_, centre - reach);
    const double right = std::min<double>(x1_, centre + reach);
    if (!(left <= right)) {
        return;
    }
    const int first = static_cast<int>(left);
    const int stopped =
        blend(splat, terms, q_row, centre, first, static_cast<int>(right), pixels_.data() + row(y));
    live_in_row_[y - y0_] -= stopped;
    live_ -= stopped;
}

int TilePainter::blend(const ProjectedSplat& splat, const SplatTerms& terms, double q_row,
                       double centre, int first, int last, Pixel* row) const {
    const double alpha_min = work_.projection.alpha_min;
    int stopped = 0;
    Pixel* pixel = row + (first - x0_);
    for (int x = first; x <= last; ++x, ++pixel) {
        const double dx = x - centre;
        const double q = terms.conic_a * dx * dx + q_row;
        if (pixel->done || q > terms.q_limit) {
            continue;
        }
        const double alpha = std::min(kAlphaMax, splat.opacity * std::exp(-0.5 * q));
        if (alpha < alpha_min) {
            continue;
        }
        const double next = pixel->transmittance * (1 - alpha);
        if (next < kStopTransmittance) {
            pixel->done = true;
            ++stopped;
            continue;
        }
        const double weight = alpha * pixel->transmittance;
        pixel->rgb[0] += splat.colour[0] * weight;
        pixel->rgb[1] += splat.colour[1] * weight;
        pixel->rgb[2] += splat.colour[2] * weight;
        pixel->transmittance = next;
        ++pixel->fragments;
    }
    return stopped;
}

void TilePainter::write(Image& image, int left, int top, ReferenceCounts& counts) const {
    for (int y = y0_; y <= y1_; ++y) {
        const Pixel* pixel = pixels_.data() + row(y);
        for (int x = x0_; x <= x1_; ++x, ++pixel) {
            const std::size_t at = image.at(x - left, y - top);
            image.put(at, pixel->rgb.data(), pixel->transmittance, pixel->fragments);
            counts.fragments += pixel->fragments;
            counts.terminated += pixel->done ? 1 : 0;
        }
    }
}

} // namespace

Image render_reference(const FrameWorkload& workload, ReferenceCounts& counts) {
    return render_reference(workload, counts, all_tiles(workload));
}

Image render_reference(const FrameWorkload& workload, ReferenceCounts& counts,
                       const TileWindow& window) {
    counts = {};
    const PixelBox box = pixels_of(workload, window);
    Image image(box.x1 - box.x0 + 1, box.y1 - box.y0 + 1);
    std::vector<ReferenceCounts> row_counts(std::max(window.y1 - window.y0 + 1, 0));
    std::vector<std::unique_ptr<TilePainter>> painters(host_threads());
    parallel_blocks(row_counts.size(), [&](std::size_t block, std::size_t worker) {
        std::unique_ptr<TilePainter>& painter = painters[worker];
        painter = painter ? std::move(painter) : std::make_unique<TilePainter>(workload);
        for (int column = window.x0; column <= window.x1; ++column) {
            const std::size_t tile = (window.y0 + block) * workload.tiles_x + column;
            const std::uint32_t* splat = workload.tile_splats.data() + workload.tile_begin[tile];
            const std::uint32_t* end = workload.tile_splats.data() + workload.tile_begin[tile + 1];
            if (splat == end) {
                continue; // the image starts as background
            }
            painter->begin(static_cast<int>(tile));
            for (; splat != end && !painter->finished(); ++splat) {
                painter->paint(workload.splats[*splat]);
            }
            painter->write(image, box.x0, box.y0, row_counts[block]);
        }
    });
    for (const ReferenceCounts& row : row_counts) {
        counts.fragments += row.fragments;
        counts.terminated += row.terminated;
    }
    return image;
}

} // namespace degs
