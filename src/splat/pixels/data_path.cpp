// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/data_path.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "base/parallel.hpp"
#include "splat/frame/pixel_index.hpp"
#include "splat/frame/pixel_rows.hpp"
#include "splat/pixels/blend_lanes.hpp"
#include "splat/pixels/checked_row.hpp"
#include "splat/pixels/quantized_data_path.hpp"
#include "splat/pixels/rasterise_rows.hpp"
#include "splat/pixels/span_record.hpp"
#include "splat/pixels/splat_places.hpp"

namespace degs {
namespace {

/// For the part of the ellipse inside a tile's columns: the same shape solved for y.
struct ColumnRecord {
    float slope;      // b/a
    float c_prime;    // 1/a
    float inverse;    // det/a
    float tip_offset; // x of the lowest point minus the mean; the highest mirrors it
};

constexpr int kFarRow = 1 << 29; // beyond every image; leaves room to add to it

std::int32_t nearest_pixel(double value) {
    constexpr double kLimit = 1 << 30;
    return static_cast<std::int32_t>(std::lround(std::clamp(value, -kLimit, kLimit)));
}

/// A derived parameter as the data path holds it.
template <class T>
T rounded(double value) {
    return static_cast<T>(value);
}

template <class T>
SpanRecord<T> derive(const ProjectedSplat& splat) {
    SpanRecord<T> record{};
    record.pixel_x = nearest_pixel(splat.mu_x);
    record.pixel_y = nearest_pixel(splat.mu_y);
    record.offset_x = rounded<T>(splat.mu_x - record.pixel_x);
    record.offset_y = rounded<T>(splat.mu_y - record.pixel_y);
    record.slope = rounded<T>(splat.cov_b / splat.cov_c);
    record.c_prime = rounded<T>(1.0 / splat.cov_c);
    record.inverse_a = rounded<T>(splat.det / splat.cov_c);
    record.a = rounded<T>(splat.cov_c / splat.det);
    record.q_threshold = rounded<T>(splat.q_end());
    record.limit = rounded<T>(kQLimit - splat.q_cut_off + (splat.q_end() - splat.q_threshold));
    record.fold = rounded<T>(2.0 * std::log(splat.opacity));
    const double reach = std::sqrt(splat.q_end() * splat.cov_c);
    record.rows = {nearest_pixel(std::ceil(splat.mu_y - reach)),
                   nearest_pixel(std::floor(splat.mu_y + reach))};
    record.columns = columns_of_box(splat);
    return record;
}

ColumnRecord derive_columns(const ProjectedSplat& splat) {
    const double reach = std::sqrt(splat.q_end() * splat.cov_c);
    return {rounded<float>(splat.cov_b / splat.cov_a), rounded<float>(1.0 / splat.cov_a),
            rounded<float>(splat.det / splat.cov_a),
            rounded<float>(splat.cov_b / splat.cov_c * reach)};
}

template <class T>
class DataPathOf final : public DataPath {
public:
    DataPathOf(const DataPathOptions& options, int tile_size, int contexts)
        : options_(options), refuse_(options.stop == StopRule::Refuse), rows_(contexts, tile_size),
          blend_(blend_function(T{})), test_(test_function(T{})), tested_(tile_size),
          products_(tile_size) {}

    std::uint32_t add_frame(const FrameWorkload& workload) override {
        const std::size_t count = workload.splats.size();
        const std::uint32_t base = places_.take(count);
        spans_.resize(places_.size());
        columns_.resize(places_.size());
        blends_.resize(places_.size());
        gemm_.resize(options_.gemm ? places_.size() : 0);
        parallel_ranges(count, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const ProjectedSplat& splat = workload.splats[i];
                spans_[base + i] = derive<T>(splat);
                columns_[base + i] = derive_columns(splat);
                blends_[base + i] = {spans_[base + i].a, rounded<T>(splat.colour[0]),
                                     rounded<T>(splat.colour[1]), rounded<T>(splat.colour[2]),
                                     spans_[base + i].limit};
                if (options_.gemm) {
                    const SpanRecord<T>& span = spans_[base + i];
                    gemm_[base + i] = gemm_splat<T>(splat, span.pixel_x, span.pixel_y,
                                                    2.0 * std::log(splat.opacity));
                }
            }
        });
        return base;
    }

    void remove_frame(std::uint32_t first, std::size_t splats) override {
        places_.release(first, splats);
    }

    void expect(std::uint32_t splat) const override {
        __builtin_prefetch(&spans_[splat]);
        __builtin_prefetch(&blends_[splat]);
    }

    PixelRange rows(std::uint32_t splat) const override { return spans_[splat].rows; }

    PixelRange columns(std::uint32_t splat) const override {
        // A rounded span end may lie a pixel beyond the box; outward ends always do.
        return spans_[splat].columns.widened(2 + options_.delta);
    }

    PixelRange box_columns(std::uint32_t splat) const override { return spans_[splat].columns; }

    // The ellipse between two columns is convex, so its lowest row is that of the
    // ellipse's own lowest point if that lies between them, else where the nearer column
    // cuts it; likewise the highest.
    PixelRange rows_in_columns(std::uint32_t splat, int x_begin, int x_end) const override {
        const SpanRecord<T>& s = spans_[splat];
        const auto offset = static_cast<float>(s.offset_x);
        const float left = static_cast<float>(x_begin - s.pixel_x) - offset;
        const float right = static_cast<float>(x_end - 1 - s.pixel_x) - offset;
        PixelRange rows = s.rows;
        // Lowest row index = smallest y: at x offset -tip; largest y at +tip.
        const ColumnRecord& c = columns_[splat];
        if (-c.tip_offset < left || -c.tip_offset > right) {
            rows.first = std::max(rows.first, cut(s, c, -c.tip_offset < left ? left : right, -1));
        }
        if (c.tip_offset < left || c.tip_offset > right) {
            rows.last = std::min(rows.last, cut(s, c, c.tip_offset < left ? left : right, +1));
        }
        return rows;
    }

    std::optional<RowSpan> solve_row(std::uint32_t splat, int y, int x_begin, int x_end,
                                     int tile_y) const override {
        std::optional<RowSpan> solved; // named by every return: built in the place of the call
        const SpanRecord<T>& s = spans_[splat];
        const T dy = below_mean(s, y);
        const T vertical = s.c_prime * dy * dy;
        const T room = s.q_threshold - vertical;
        if (!(room >= 0)) {
            return solved;
        }
        const T width = std::sqrt(room * s.inverse_a);
        const T centre = s.offset_x + s.slope * dy; // relative to pixel_x
        T left = centre - width;
        T right = centre + width;
        if (options_.ends == SpanEnds::Exact) {
            left = std::ceil(left);
            right = std::floor(right);
        } else {
            const T delta = static_cast<T>(options_.delta);
            left = std::floor(left) - delta;
            right = std::ceil(right) + delta;
        }
        left = std::max(left, static_cast<T>(x_begin - s.pixel_x));
        right = std::min(right, static_cast<T>(x_end - 1 - s.pixel_x));
        if (!(left <= right)) {
            return solved;
        }
        // Beyond 2^24 px from the mean a float does not name single pixels, and left may be rounded
        // out of the tile.
        const int x0 = std::max(static_cast<std::int32_t>(left) + s.pixel_x, x_begin);
        const int x1 = std::min(static_cast<std::int32_t>(right) + s.pixel_x, x_end - 1);
        if (x0 > x1) {
            return solved;
        }
        const T start = left - centre;
        RowSpan& span = solved.emplace();
        span.splat = splat;
        span.y = inside_tile(y - tile_y);
        span.x0 = inside_tile(x0 - x_begin);
        span.length = inside_tile(x1 - x0 + 1);
        span.base = span.x0;
        span.g0 = s.a * start * start + vertical - s.fold;
        span.d0 = s.a * (2 * start + 1);
        return solved;
    }

    void begin_row(int context, int row) override { rows_.release(context, row); }

    BlendOutcome blend(const BlendTask& task) override {
        const std::size_t first = at(task.context, task.row, task.column);
        return blend_(task, blends_[task.splat], refuse_, pixels_, first);
    }

    void rasterise_rows(const TileRows& rows, RowOutcome* outcomes) override {
        if constexpr (std::is_same_v<T, float>) {
            if (!rows.tests) {
                firsts_.resize(std::max<std::size_t>(firsts_.size(), rows.last + 1));
                for (int row = rows.first; row <= rows.last; row += rows.step) {
                    firsts_[row] = at(rows.context, row, 0);
                }
                const EndsOfRows ends{options_.ends == SpanEnds::Exact,
                                      static_cast<float>(options_.delta)};
                rasterise_(rows, spans_[rows.splat], blends_[rows.splat], ends, refuse_, pixels_,
                           firsts_.data(), outcomes);
                return;
            }
        }
        rasterise_row_by_row(*this, rows, outcomes);
    }

    void hold_contexts(int contexts) override { rows_.hold(contexts); }

    BlendOutcome test(const PixelTest& test) override {
        BlendOutcome outcome;
        test_rows(test, 1, &outcome);
        return outcome;
    }

    void test_rows(const PixelTest& test, int rows, BlendOutcome* outcomes) override {
        if (options_.gemm) {
            product_rows(test, rows, outcomes);
            return;
        }
        for (int i = 0; i < rows; ++i) {
            tested_[i] = test_row(test, i);
        }
        test_(tested_.data(), rows, blends_[test.splat], refuse_, pixels_, outcomes);
    }

    // The rows of rows_in_columns(), whose ends were found in double: rounding may add some to the
    // ellipse's own.
    PixelRange tested_rows(std::uint32_t splat, const PixelRange& columns,
                           const PixelRange& rows) const override {
        const SpanRecord<T>& s = spans_[splat];
        PixelRange found = rows_in_columns(splat, columns.first, columns.last + 1).within(rows);
        const auto passes = [&](int y) { return lowest_q(s, below_mean(s, y)) <= s.limit; };
        while (found.first > rows.first && found.first <= s.rows.first && passes(found.first - 1)) {
            --found.first;
        }
        while (found.last < rows.last && found.last >= s.rows.last && passes(found.last + 1)) {
            ++found.last;
        }
        return found;
    }

    PixelRange tested_columns(std::uint32_t splat, int y, int x_begin, int x_end) const override {
        const SpanRecord<T>& s = spans_[splat];
        const PixelRange bounds{x_begin, x_end - 1};
        return checked_row(s, y).columns(bounds.relative_to(s.pixel_x)).relative_to(-s.pixel_x);
    }

    bool rounds_coarsely() const override { return false; }

    void read_row(int context, int row, int count, PixelValue* pixels) const override {
        if (!rows_.placed(context, row)) {
            std::fill_n(pixels, count, PixelValue{});
            return;
        }
        const std::size_t first = rows_.first_pixel(context, row);
        for (int i = 0; i < count; ++i) {
            pixels[i] = pixels_.read(first + i);
        }
    }

    PixelValue read_pixel(int context, int row, int column) const override {
        return rows_.placed(context, row) ? pixels_.read(rows_.first_pixel(context, row) + column)
                                          : PixelValue{};
    }

    void write_pixel(int context, int row, int column, const PixelValue& value) override {
        pixels_.write(at(context, row, column), value);
    }

private:
    // Distance of a row from the mean, px.
    static T below_mean(const SpanRecord<T>& s, int y) {
        return static_cast<T>(y - s.pixel_y) - s.offset_y;
    }
    // q' at the centre of a row.
    static T lowest_q(const SpanRecord<T>& s, T dy) { return s.c_prime * dy * dy - s.fold; }
    // Row at which column dx (from the mean) leaves the ellipse, upwards (-1) or downwards (+1),
    // with a row of slack; beyond every row if the column misses the ellipse.
    static int cut(const SpanRecord<T>& s, const ColumnRecord& c, float dx, int direction) {
        const auto q_threshold = static_cast<float>(s.q_threshold);
        const float room = q_threshold - c.c_prime * dx * dx;
        if (!(room >= -1e-3F)) {
            return direction < 0 ? kFarRow : -kFarRow;
        }
        // The two terms of `room` cancel where the column just touches the ellipse: with their
        // rounding added, a steep needle loses no row.
        const float rounding = 1e-6F * (q_threshold + 1);
        const float height = std::sqrt(std::max(room + rounding, 0.0F) * c.inverse);
        const float y =
            static_cast<float>(s.offset_y) + c.slope * dx + static_cast<float>(direction) * height;
        const float limited = std::min(std::max(y, -1e8F), 1e8F);
        const float slack = 0.01F + 1e-6F * (std::abs(limited) + std::abs(c.slope * dx) + height);
        return s.pixel_y + static_cast<int>(direction < 0 ? std::ceil(limited - slack)
                                                          : std::floor(limited + slack));
    }
    static CheckedRow<T> checked_row(const SpanRecord<T>& s, int y) {
        const T dy = below_mean(s, y);
        return {s.offset_x + s.slope * dy, lowest_q(s, dy), s.a, s.inverse_a, s.limit};
    }
    // The row `below` rows below that of `test`.
    TestRow<T> test_row(const PixelTest& test, int below) {
        const SpanRecord<T>& s = spans_[test.splat];
        const CheckedRow<T> row = checked_row(s, test.y + below);
        return {row.centre, row.rest, test.x - s.pixel_x, test.mask,
                at(test.context, test.row + below, test.column)};
    }
    void product_rows(const PixelTest& test, int rows, BlendOutcome* outcomes) {
        const int x = gemm_origin(*options_.gemm, test.x - test.column, rows_.rows());
        const int y = gemm_origin(*options_.gemm, test.y - test.row, rows_.rows());
        for (int i = 0; i < rows; ++i) {
            products_[i] = {test.x - x, test.y + i - y, test.mask,
                            at(test.context, test.row + i, test.column)};
        }
        const GemmSplat<T>& splat = gemm_[test.splat];
        BlendRecord<T> record = blends_[test.splat];
        if (splat.cut) {
            constexpr int kPixels = 32; // of a mask
            const int top = test.y - test.row, bottom = top + rows_.rows();
            record.limit +=
                splat.margin(x, y, std::max(std::abs(test.x - x), std::abs(test.x + kPixels - x)),
                             std::max(std::abs(top - y), std::abs(bottom - y)));
        }
        product_(products_.data(), rows, splat.row(x, y), record, refuse_, pixels_, outcomes);
    }
    std::size_t at(int context, int row, int column) {
        return rows_.ready(context, row, pixels_) + column;
    }

    DataPathOptions options_;
    bool refuse_;
    PixelRows rows_;
    PixelPlanes<T> pixels_;
    BlendFunction<T> blend_;
    TestFunction<T> test_;
    RasteriseFunction rasterise_ = rasterise_function();
    std::vector<std::size_t> firsts_; // first pixels of rows for rasterise_
    std::vector<TestRow<T>> tested_;  // rows for test_
    ProductFunction<T> product_ = product_function(T{});
    std::vector<ProductRow> products_; // rows for product_
    SplatPlaces places_;               // of frames in the tables that follow
    std::vector<GemmSplat<T>> gemm_;   // if the options ask for products
    std::vector<SpanRecord<T>> spans_;
    std::vector<ColumnRecord> columns_;
    std::vector<BlendRecord<T>> blends_;
};

} // namespace

std::unique_ptr<DataPath> make_data_path(const DataPathOptions& options, int tile_size,
                                         int contexts) {
    const Arithmetic numbers = options.numbers;
    if (options.set) {
        return make_quantized_data_path(*options.set, options, tile_size, contexts);
    }
    if (numbers == Arithmetic::Fp32) {
        return std::make_unique<DataPathOf<float>>(options, tile_size, contexts);
    }
    if (numbers == Arithmetic::Fp64 || numbers == Arithmetic::Ideal) {
        return std::make_unique<DataPathOf<double>>(options, tile_size, contexts);
    }
    return make_quantized_data_path(number_set(name_of(numbers)), options, tile_size, contexts);
}

} // namespace degs
