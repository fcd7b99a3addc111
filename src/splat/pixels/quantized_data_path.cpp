// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/quantized_data_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/parallel.hpp"
#include "splat/frame/pixel_index.hpp"
#include "splat/frame/pixel_rows.hpp"
#include "splat/pixels/coupled_row.hpp"
#include "splat/pixels/quantized_extent.hpp"
#include "splat/pixels/quantized_gemm.hpp"
#include "splat/pixels/quantized_pixels.hpp"
#include "splat/pixels/rasterise_rows.hpp"
#include "splat/pixels/row_lanes.hpp"
#include "splat/pixels/splat_places.hpp"

namespace degs {
namespace {

NumberSet with_ends(NumberSet set, const DataPathOptions& options) {
    set.ends = options.ends;
    set.delta = options.delta;
    return set;
}

/// The last that is inside on the way from `in`, which is, to `beyond`, which is not.
template <class Inside>
int outermost(const Inside& inside, int in, int beyond) {
    while (std::abs(beyond - in) > 1) {
        const int middle = in + (beyond - in) / 2;
        (inside(middle) ? in : beyond) = middle;
    }
    return in;
}

class QuantizedDataPath final : public DataPath {
public:
    QuantizedDataPath(const NumberSet& set, const DataPathOptions& options, int tile_size,
                      int contexts)
        : row_(with_ends(set, options)), gemm_(row_, options.gemm), numbers_(row_.set()),
          slack_(row_.set()), refuse_(options.stop == StopRule::Refuse), rows_(contexts, tile_size),
          pixels_(make_quantized_pixels(row_)) {}

    std::uint32_t add_frame(const FrameWorkload& workload) override {
        const std::size_t count = workload.splats.size();
        const std::uint32_t base = places_.take(count);
        splats_.resize(places_.size());
        extents_.resize(places_.size());
        boxes_.resize(places_.size());
        gemm_.resize(places_.size());
        parallel_ranges(count, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                splats_[base + i] = row_.record(workload.splats[i]);
                extents_[base + i] = QuantizedExtent(row_, slack_, splats_[base + i]);
                boxes_[base + i] = columns_of_box(workload.splats[i]);
                gemm_.set(base + i, workload.splats[i]);
            }
        });
        for (std::size_t i = base; i < base + count; ++i) {
            pixels_->set(i, splats_[i]);
        }
        return base;
    }

    void remove_frame(std::uint32_t first, std::size_t splats) override {
        places_.release(first, splats);
    }

    void expect(std::uint32_t splat) const override {
        const auto* record = reinterpret_cast<const char*>(&splats_[splat]);
        __builtin_prefetch(record);
        __builtin_prefetch(record + sizeof(QuantizedSplat) - 1);
        __builtin_prefetch(&extents_[splat]);
    }

    PixelRange rows(std::uint32_t splat) const override { return extents_[splat].rows(); }

    PixelRange columns(std::uint32_t splat) const override { return extents_[splat].columns(); }

    PixelRange box_columns(std::uint32_t splat) const override { return boxes_[splat]; }

    PixelRange rows_in_columns(std::uint32_t splat, int x_begin, int x_end) const override {
        return extents_[splat].rows_in_columns(x_begin, x_end);
    }

    std::optional<RowSpan> solve_row(std::uint32_t splat, int y, int x_begin, int x_end,
                                     int tile_y) const override {
        std::optional<RowSpan> result; // named by every return: built in the place of the call
        const QuantizedSpan solved = row_.solve(splats_[splat], y, x_begin, x_end);
        if (!solved.empty()) {
            result = row_span(solved, x_begin);
            result->splat = splat;
            result->y = inside_tile(y - tile_y);
        }
        return result;
    }

    void begin_row(int context, int row) override { rows_.release(context, row); }

    // The first update of a row is apart, so that all others pass through without a frame of this.
    BlendOutcome blend(const BlendTask& task) override {
        if (!rows_.placed(task.context, task.row)) {
            return begin_and_blend(task);
        }
        return pixels_->blend(task, refuse_,
                              rows_.first_pixel(task.context, task.row) + task.column);
    }

    BlendOutcome test(const PixelTest& test) override {
        double q[32] = {};
        if (gemm_.wanted()) {
            gemm_.exponents(test, rows_.rows(), q);
            return pixels_->test(test.splat, test.mask, q, refuse_,
                                 at(test.context, test.row, test.column));
        }
        const QuantizedSplat& splat = splats_[test.splat];
        const QuantizedCheck row = row_.check(splat, test.y);
        if (!row.possible) {
            BlendOutcome outcome;
            outcome.boundary = test.mask;
            return outcome;
        }
        for (std::uint32_t left = test.mask; left != 0; left &= left - 1) {
            const int i = __builtin_ctz(left);
            q[i] = row_.checked_q(splat, row, test.x + i);
        }
        return pixels_->test(test.splat, test.mask, q, refuse_,
                             at(test.context, test.row, test.column));
    }

    void test_rows(const PixelTest& test, int rows, BlendOutcome* outcomes) override {
        PixelTest row = test;
        for (int i = 0; i < rows; ++i, ++row.y, ++row.row) {
            outcomes[i] = this->test(row);
        }
    }

    // Rounding keeps order, so the row nearest to the mean decides whether there are any.
    PixelRange tested_rows(std::uint32_t splat, const PixelRange& /*columns*/,
                           const PixelRange& rows) const override {
        const QuantizedSplat& s = splats_[splat];
        const auto possible = [&](int y) { return row_.check(s, y).possible; };
        if (rows.empty()) {
            return {};
        }
        const int nearest =
            index_within(std::nearbyint(s.pixel_y + s.mean_y), rows.first, rows.last);
        if (!possible(nearest)) {
            return {};
        }
        return {outermost(possible, nearest, rows.first - 1),
                outermost(possible, nearest, rows.last + 1)};
    }

    // The pixel nearest to the centre decides whether there are any; away from it q' never falls.
    PixelRange tested_columns(std::uint32_t splat, int y, int x_begin, int x_end) const override {
        const QuantizedSplat& s = splats_[splat];
        const QuantizedCheck row = row_.check(s, y);
        if (!row.possible || !std::isfinite(row.centre) || x_begin >= x_end) {
            return {};
        }
        const auto inside = [&](int x) { return row_.checked_q(s, row, x) <= s.q_inside; };
        const double low = x_begin - s.pixel_x;
        const double high = x_end - 1 - s.pixel_x;
        const int nearest =
            x_begin + static_cast<int>(std::clamp(std::nearbyint(row.centre), low, high) - low);
        if (!inside(nearest)) {
            return {};
        }
        return {outermost(inside, nearest, x_begin - 1), outermost(inside, nearest, x_end)};
    }

    bool rounds_coarsely() const override { return true; }

    void rasterise_rows(const TileRows& rows, RowOutcome* outcomes) override {
        if (!rows.tests) {
            solve_rows(rows);
        }
        const auto solved = [this](int index, int /*row*/) -> const RowSpan& {
            return solved_[index];
        };
        rasterise_row_by_row(*this, rows, solved, outcomes);
    }

    void hold_contexts(int contexts) override { rows_.hold(contexts); }

    void read_row(int context, int row, int count, PixelValue* pixels) const override {
        if (!rows_.placed(context, row)) {
            std::fill_n(pixels, count, PixelValue{});
            return;
        }
        const std::size_t first = rows_.first_pixel(context, row);
        for (int i = 0; i < count; ++i) {
            pixels[i] = pixels_->read(first + i);
        }
    }

    PixelValue read_pixel(int context, int row, int column) const override {
        return rows_.placed(context, row) ? pixels_->read(rows_.first_pixel(context, row) + column)
                                          : PixelValue{};
    }

    void write_pixel(int context, int row, int column, const PixelValue& value) override {
        pixels_->write(at(context, row, column), value);
    }

private:
    void solve_rows(const TileRows& rows) {
        RowsToSolve wanted;
        wanted.y = rows.tile_y + rows.first;
        wanted.step = rows.step;
        wanted.count = rows.last < rows.first ? 0 : (rows.last - rows.first) / rows.step + 1;
        wanted.x_begin = rows.x_begin;
        wanted.x_end = rows.x_end;
        const QuantizedSplat& splat = splats_[rows.splat];
        for (std::uint64_t left = solve_(numbers_, splat, wanted, solved_.data()); left != 0;
             left &= left - 1) {
            const int i = __builtin_ctzll(left);
            solved_[i] = row_span(
                row_.solve(splat, wanted.y + i * wanted.step, wanted.x_begin, wanted.x_end),
                wanted.x_begin);
        }
    }
    [[gnu::noinline]] BlendOutcome begin_and_blend(const BlendTask& task) {
        return pixels_->blend(task, refuse_, at(task.context, task.row, task.column));
    }
    std::size_t at(int context, int row, int column) {
        return rows_.ready(context, row, *pixels_) + column;
    }

    QuantizedRow row_;
    QuantizedGemm gemm_;
    RowNumbers numbers_;
    SolveRowsFunction solve_ = solve_rows_function();
    std::array<RowSpan, kMostRowsAtOnce> solved_; // of the splat that is rasterised
    QuantizedSlack slack_;
    bool refuse_;
    PixelRows rows_;
    std::unique_ptr<QuantizedPixels> pixels_;
    SplatPlaces places_; // of frames in the tables of splats, those of pixels_ and gemm_ included
    std::vector<QuantizedSplat> splats_;
    std::vector<QuantizedExtent> extents_;
    std::vector<PixelRange> boxes_; // columns
};

} // namespace

std::unique_ptr<DataPath> make_quantized_data_path(const NumberSet& set,
                                                   const DataPathOptions& options, int tile_size,
                                                   int contexts) {
    return std::make_unique<QuantizedDataPath>(set, options, tile_size, contexts);
}

} // namespace degs
