// SPDX-License-Identifier: Apache-2.0
#include "accuracy/data_path_renderer.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/ratio.hpp"
#include "splat/frame/pixel_index.hpp"
#include "splat/frame/pixel_mask.hpp"
#include "splat/pixels/coupled_row.hpp"

namespace degs {
namespace {

constexpr int kRun = 32; ///< pixels that a BlendTask can name

int ones(std::uint32_t mask) {
    return __builtin_popcount(mask);
}

} // namespace

/// One tile at a time on one context of a data path.
class DataPathRenderer::TileBlender {
public:
    TileBlender(const FrameWorkload& work, const DataPathRender& options, DataPathCounts& counts)
        : work_(work), rows_in_columns_(options.rows_in_columns),
          parsing_(options.parsing && !options.numbers.gemm), whole_(options.numbers.gemm),
          counts_(counts), path_(make_data_path(options.numbers, work.tile_size, 1)),
          base_(path_->add_frame(work)), live_in_row_(work.tile_size), row_(work.tile_size) {}

    /// Blends the tile's list; false if it has none.
    bool blend(int column, int row);
    /// Copies the tile to the image, whose first pixel is (x, y) of the raster.
    void write(Image& image, int x, int y);

private:
    void blend_splat(std::uint32_t splat);
    void blend_span(const RowSpan& span);
    std::optional<RowSpan> span_of(std::uint32_t splat, int y) const {
        std::optional<RowSpan> row;
        if (whole_) {
            row.emplace();
            row->splat = splat;
            row->y = inside_tile(y - box_.y0);
            row->length = inside_tile(box_.width());
        } else {
            row = parsing_ ? path_->solve_row(splat, y, box_.x0, box_.x1 + 1, box_.y0)
                           : row_of_box(*path_, splat, y, box_.x0, box_.x1 + 1, box_.y0);
        }
        const PixelRange columns = PixelRange{image_box_.x0, image_box_.x1}.relative_to(box_.x0);
        return row && cut(*row, columns) ? row : std::nullopt;
    }

    const FrameWorkload& work_;
    bool rows_in_columns_, parsing_, whole_;
    DataPathCounts& counts_;
    std::unique_ptr<DataPath> path_;
    std::uint32_t base_;           ///< index of the frame's first splat
    std::vector<int> live_in_row_; ///< pixels that have not ended
    std::vector<PixelValue> row_;
    int live_ = 0;
    PixelBox box_;       ///< the tile's pixels
    PixelBox image_box_; ///< those in the image
};

bool DataPathRenderer::TileBlender::blend(int column, int row) {
    const int tile = row * work_.tiles_x + column;
    const std::uint32_t* splat = work_.tile_splats.data() + work_.tile_begin[tile];
    const std::uint32_t* end = work_.tile_splats.data() + work_.tile_begin[tile + 1];
    if (splat == end) {
        return false;
    }
    const TileGrid grid = work_.grid();
    box_ = grid.pixels_of(tile);
    image_box_ = grid.image_pixels_of(tile);
    for (int y = 0; y < work_.tile_size; ++y) {
        path_->begin_row(0, y);
    }
    std::fill(live_in_row_.begin(), live_in_row_.end(), image_box_.width());
    live_ = image_box_.width() * image_box_.height();
    for (; splat != end && live_ > 0; ++splat) {
        blend_splat(base_ + *splat);
    }
    return true;
}

void DataPathRenderer::TileBlender::blend_splat(std::uint32_t splat) {
    const PixelRange met = whole_             ? PixelRange{box_.y0, box_.y1}
                           : rows_in_columns_ ? path_->rows_in_columns(splat, box_.x0, box_.x1 + 1)
                                              : path_->rows(splat);
    const PixelRange rows = met.within({image_box_.y0, image_box_.y1});
    for (int y = rows.first; y <= rows.last; ++y) {
        if (live_in_row_[y - box_.y0] == 0) {
            continue;
        }
        if (const auto span = span_of(splat, y)) {
            blend_span(*span);
        }
    }
}

void DataPathRenderer::TileBlender::blend_span(const RowSpan& span) {
    ++counts_.spans;
    const int end = span.x0 + span.length - 1;
    BlendTask task;
    task.g0 = span.g0;
    task.d0 = span.d0;
    task.splat = span.splat;
    task.row = span.y;
    for (int column = span.x0 / kRun * kRun; column <= end; column += kRun) {
        task.mask = bits_between(std::max(span.x0 - column, 0), std::min(end + 1 - column, kRun));
        task.column = inside_tile(column);
        task.offset = inside_tile(column - span.base);
        const BlendOutcome outcome =
            parsing_ ? path_->blend(task) : path_->test(test_of(task, box_.x0, box_.y0));
        counts_.useful += ones(outcome.useful);
        counts_.boundary += ones(outcome.boundary);
        counts_.terminated += ones(outcome.terminated);
        live_ -= ones(outcome.ended);
        live_in_row_[span.y] -= ones(outcome.ended);
    }
}

void DataPathRenderer::TileBlender::write(Image& image, int x, int y) {
    const PixelRange columns = PixelRange{image_box_.x0, image_box_.x1}.relative_to(box_.x0);
    for (int row = image_box_.y0; row <= image_box_.y1; ++row) {
        path_->read_row(0, row - box_.y0, columns.last + 1, row_.data());
        std::size_t at = image.at(image_box_.x0 - x, row - y);
        for (int column = columns.first; column <= columns.last; ++column, ++at) {
            const PixelValue& pixel = row_[column];
            image.put(at, pixel.rgb, pixel.transmittance, pixel.updates);
        }
    }
}

DataPathRenderer::DataPathRenderer(const FrameWorkload& workload, DataPathRender options)
    : work_(workload), progress_(std::move(options.progress)),
      blender_(std::make_unique<TileBlender>(workload, options, counts_)) {}

DataPathRenderer::~DataPathRenderer() = default;

Image DataPathRenderer::render(const TileWindow& window) {
    const PixelBox box = pixels_of(work_, window);
    Image image(box.x1 - box.x0 + 1, box.y1 - box.y0 + 1);
    for (int row = window.y0; row <= window.y1; ++row) {
        for (int column = window.x0; column <= window.x1; ++column) {
            if (blender_->blend(column, row)) { // else background
                blender_->write(image, box.x0, box.y0);
            }
        }
        if (progress_) {
            progress_(ratio_of(row - window.y0 + 1, window.y1 - window.y0 + 1));
        }
    }
    return image;
}

} // namespace degs
