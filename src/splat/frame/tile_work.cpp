// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/tile_work.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "config/ratio.hpp"
#include "splat/frame/fast_exp.hpp"
#include "splat/pixel_rules.hpp"

namespace degs {
namespace {

/// The numbers of a splat that a row needs, close together: lists visit splats in no order.
struct SplatRow {
    float mu_x, mu_y, reach_y;
    float conic_a, slope, inverse_c, det_over_c;
    float q_threshold, opacity;
};

std::vector<SplatRow> rows_of(const FrameWorkload& frame) {
    std::vector<SplatRow> rows;
    rows.reserve(frame.splats.size());
    const auto single = [](double value) { return static_cast<float>(value); };
    for (const ProjectedSplat& s : frame.splats) {
        rows.push_back({single(s.mu_x), single(s.mu_y), single(std::sqrt(s.q_threshold * s.cov_c)),
                        single(s.conic_a()), single(s.cov_b / s.cov_c), single(1 / s.cov_c),
                        single(s.det / s.cov_c), single(s.q_threshold), single(s.opacity)});
    }
    return rows;
}

/// The sampled rows of one tile.
class SampledTile {
public:
    SampledTile(const FrameWorkload& frame, const std::vector<SplatRow>& splats, int rows_apart)
        : frame_(frame), splats_(splats), rows_apart_(rows_apart),
          width_(std::min(frame.tile_size, frame.camera.width)) {}

    TileWork render(int tile);

private:
    struct Row {
        int y, live;
    };
    void choose_rows(int tile);
    void blend(const SplatRow& splat, Row& row, float* transmittance);

    const FrameWorkload& frame_;
    const std::vector<SplatRow>& splats_;
    int rows_apart_, width_;
    int x0_ = 0, x1_ = 0, y0_ = 0, y1_ = 0; ///< px, inclusive
    std::vector<Row> rows_;
    std::vector<float> transmittance_; ///< of the sampled rows; 0: ended
    std::uint64_t rows_met_ = 0, tasks_ = 0, fragments_ = 0;
    int live_ = 0; ///< pixels
};

void SampledTile::choose_rows(int tile) {
    const int size = frame_.tile_size;
    x0_ = tile % frame_.tiles_x * size;
    y0_ = tile / frame_.tiles_x * size;
    x1_ = std::min(x0_ + size, frame_.camera.width) - 1;
    y1_ = std::min(y0_ + size, frame_.camera.height) - 1;
    const int height = y1_ - y0_ + 1;
    const int apart = std::min(rows_apart_, height);
    constexpr int kStride = 7; // neighbouring tiles get rows at different heights
    rows_.clear();
    for (int y = y0_ + tile * kStride % apart; y <= y1_; y += apart) {
        rows_.push_back({y, x1_ - x0_ + 1});
    }
    transmittance_.assign(rows_.size() * width_, 1.0F);
    live_ = static_cast<int>(rows_.size()) * (x1_ - x0_ + 1);
    rows_met_ = tasks_ = fragments_ = 0;
}

void SampledTile::blend(const SplatRow& splat, Row& row, float* transmittance) {
    const float dy = static_cast<float>(row.y) - splat.mu_y;
    const float q_row = dy * dy * splat.inverse_c;
    const float rest = splat.q_threshold - q_row;
    if (rest < 0) {
        return;
    }
    const float centre = splat.mu_x + splat.slope * dy;
    const float reach = std::sqrt(rest * splat.det_over_c);
    const float left = std::max(std::ceil(centre - reach), static_cast<float>(x0_));
    const float right = std::min(std::floor(centre + reach), static_cast<float>(x1_));
    ++rows_met_;
    if (!(left <= right)) {
        return;
    }
    const int first = static_cast<int>(left), count = static_cast<int>(right) - first + 1;
    float* const pixel = transmittance + (first - x0_);
    const float start = left - centre;
    int blended = 0, ended = 0;
    for (int i = 0; i < count; ++i) {
        const float dx = start + static_cast<float>(i);
        const float q = splat.conic_a * dx * dx + q_row;
        const float alpha =
            std::min(static_cast<float>(kAlphaMax), splat.opacity * fast_exp(-0.5F * q));
        const float next = pixel[i] * (1.0F - alpha);
        const bool kept = next >= static_cast<float>(kStopTransmittance);
        blended += kept ? 1 : 0;
        ended += !kept && pixel[i] > 0 ? 1 : 0;
        pixel[i] = kept ? next : 0.0F;
    }
    tasks_ += count;
    fragments_ += blended;
    row.live -= ended;
    live_ -= ended;
}

TileWork SampledTile::render(int tile) {
    choose_rows(tile);
    TileWork work;
    const double height = y1_ - y0_ + 1;
    work.pixels = height * (x1_ - x0_ + 1);
    const std::uint64_t begin = frame_.tile_begin[tile], end = frame_.tile_begin[tile + 1];
    std::uint64_t entry = begin;
    for (; entry != end && live_ != 0; ++entry) {
        const SplatRow& splat = splats_[frame_.tile_splats[entry]];
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            Row& row = rows_[r];
            if (row.live != 0 &&
                std::abs(static_cast<float>(row.y) - splat.mu_y) <= splat.reach_y) {
                blend(splat, row, transmittance_.data() + r * width_);
            }
        }
    }
    const double scale = height / static_cast<double>(rows_.size());
    work.entries = rate_of(end - begin, 1);
    work.walked = rate_of(entry - begin, 1);
    work.rows = scale * rate_of(rows_met_, 1);
    work.tasks = scale * rate_of(tasks_, 1);
    work.fragments = scale * rate_of(fragments_, 1);
    return work;
}

} // namespace

TileWork& TileWork::operator+=(const TileWork& other) {
    tiles += other.tiles;
    pixels += other.pixels;
    entries += other.entries;
    walked += other.walked;
    rows += other.rows;
    tasks += other.tasks;
    fragments += other.fragments;
    return *this;
}

std::vector<TileWork> estimate_tile_work(const FrameWorkload& frame, int rows_apart) {
    const std::vector<SplatRow> splats = rows_of(frame);
    SampledTile sample(frame, splats, rows_apart);
    std::vector<TileWork> work;
    work.reserve(frame.tiles());
    for (int tile = 0; tile < frame.tiles(); ++tile) {
        work.push_back(sample.render(tile));
    }
    return work;
}

} // namespace degs
