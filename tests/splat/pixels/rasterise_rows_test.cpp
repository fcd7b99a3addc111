// SPDX-License-Identifier: Apache-2.0
// Rows that are rasterised whole are those that are solved and blended segment by segment, to the
// last bit.
#include <algorithm>
#include <cstring>
#include <tuple>

#include "splat/frame/pixel_mask.hpp"
#include "splat/pixels/blend_lanes.hpp"
#include "splat/pixels/coupled_row.hpp"
#include "tests/splat/pixels/data_path_fixture.hpp"

namespace degs {
namespace {

constexpr int kSegment = 16;
constexpr int kTileX = 128, kTileY = 64;

/// A row of a splat as Span Units and PEs do it.
RowOutcome by_segments(DataPath& path, const TileRows& rows, int row) {
    const int y = rows.tile_y + row;
    const std::optional<RowSpan> span =
        rows.tests ? row_of_box(path, rows.splat, y, rows.x_begin, rows.x_end, rows.tile_y)
                   : path.solve_row(rows.splat, y, rows.x_begin, rows.x_end, rows.tile_y);
    RowOutcome outcome_of_row;
    if (!span) {
        return outcome_of_row;
    }
    outcome_of_row.x0 = span->x0;
    outcome_of_row.length = span->length;
    for (int column = 0; column < rows.x_end - rows.x_begin; column += kSegment) {
        const int begin = std::clamp(span->x0 - column, 0, kSegment);
        const int end = std::clamp(span->x0 + span->length - column, 0, kSegment);
        BlendTask task;
        task.g0 = span->g0;
        task.d0 = span->d0;
        task.splat = rows.splat;
        task.mask = begin < end ? bits_between(begin, end) : 0;
        task.row = inside_tile(row);
        task.column = inside_tile(column);
        task.offset = inside_tile(column - span->base);
        task.context = inside_tile(rows.context);
        if (task.mask == 0) {
            continue;
        }
        const BlendOutcome outcome =
            rows.tests ? path.test(test_of(task, rows.x_begin, rows.tile_y)) : path.blend(task);
        outcome_of_row.inside.put(outcome.useful | outcome.terminated, column);
        outcome_of_row.useful.put(outcome.useful, column);
        outcome_of_row.ended.put(outcome.ended, column);
    }
    return outcome_of_row;
}

void expect_same(const RowOutcome& found, const RowOutcome& expected) {
    EXPECT_EQ(found.length, expected.length);
    EXPECT_EQ(found.length == 0 ? 0 : found.x0, expected.length == 0 ? 0 : expected.x0);
    EXPECT_TRUE(found.inside == expected.inside);
    EXPECT_TRUE(found.useful == expected.useful);
    EXPECT_TRUE(found.ended == expected.ended);
}

void expect_same(const PixelValue& pixel, const PixelValue& expected) {
    EXPECT_EQ(std::memcmp(pixel.rgb, expected.rgb, sizeof pixel.rgb), 0);
    EXPECT_EQ(pixel.transmittance, expected.transmittance);
    EXPECT_EQ(pixel.updates, expected.updates);
    EXPECT_EQ(pixel.ended, expected.ended);
}

std::vector<ProjectedSplat> splats_near(int size, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 150; ++i) {
        splats.push_back(test::random_splat(random, kTileX, kTileY, size));
        if (i % 5 == 0) { // opaque in the middle, so that pixels end
            splats.push_back(
                test::make_splat(kTileX + size / 2.0, kTileY + size / 3.0, size, size, 0, 0.9));
        }
    }
    return splats;
}

/// Numbers, tile size, whether the PEs test.
class RasteriseRows
    : public ::testing::TestWithParam<std::tuple<Arithmetic, int, bool, SpanEnds, StopRule>> {};

TEST_P(RasteriseRows, AreSegmentsInOneGo) {
    const auto [numbers, size, tests, ends, stop] = GetParam();
    DataPathOptions options = test::path_options(numbers, ends, ends == SpanEnds::Exact ? 0 : 1);
    options.stop = stop;
    const std::vector<ProjectedSplat> splats = splats_near(size, 7);
    const auto path = test::path_of(splats, options, size);
    const auto other = test::path_of(splats, options, size);
    constexpr int kContext = 3;
    path->hold_contexts(kContext + 1);
    TileRows rows;
    rows.context = kContext;
    rows.x_begin = kTileX;
    rows.x_end = kTileX + size - 3; // the image ends inside the tile
    rows.tile_y = kTileY;
    rows.tests = tests;
    std::vector<RowOutcome> outcomes(size);
    int ended = 0;
    for (std::uint32_t s = 0; s < splats.size(); ++s) {
        rows.splat = s;
        rows.step = 1 + static_cast<int>(s % 3);
        rows.first = static_cast<int>(s % 5);
        rows.last = std::min(size - 1 - static_cast<int>(s % 2),
                             rows.first + (kMostRowsAtOnce - 1) * rows.step);
        path->rasterise_rows(rows, outcomes.data());
        TileRows here = rows;
        here.context = 0;
        const RowOutcome* next = outcomes.data();
        for (int row = rows.first; row <= rows.last; row += rows.step) {
            expect_same(*next, by_segments(*other, here, row));
            ended += next++->ended.count();
        }
    }
    EXPECT_NE(ended, 0) << "no pixel ended, so the test says little";
    for (int row = 0; row < size; ++row) {
        for (int column = 0; column < size; ++column) {
            expect_same(path->read_pixel(kContext, row, column), other->read_pixel(0, row, column));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Numbers, RasteriseRows,
                         ::testing::Combine(::testing::Values(Arithmetic::Fp32, Arithmetic::Fp64,
                                                              Arithmetic::Fp16, Arithmetic::Paper,
                                                              Arithmetic::Tuned),
                                            ::testing::Values(8, 32, 64, 128), ::testing::Bool(),
                                            ::testing::Values(SpanEnds::Exact, SpanEnds::Outward),
                                            ::testing::Values(StopRule::Refuse, StopRule::After)));

// The widest vectors, which the data path uses, and all others.
TEST(RasteriseVariants, GiveTheSameBits) {
    SpanRecord<float> span{};
    span.pixel_x = 20;
    span.pixel_y = 9;
    span.offset_x = 0.3F;
    span.offset_y = -0.2F;
    span.slope = 0.4F;
    span.c_prime = 0.05F;
    span.inverse_a = 90;
    span.a = 1.0F / 90;
    span.q_threshold = 10;
    span.fold = -0.1F;
    const BlendRecord<float> splat{span.a, 0.1F, 0.5F, 0.9F};
    constexpr std::size_t kRows = 20, kStride = 64;
    std::vector<std::size_t> firsts;
    for (std::size_t row = 0; row < kRows; ++row) {
        firsts.push_back(row * kStride);
    }
    TileRows rows;
    rows.x_end = 45;
    rows.last = kRows - 1;
    const std::vector<RasteriseFunction> variants = rasterise_variants();
    ASSERT_FALSE(variants.empty());
    for (const bool exact : {true, false}) {
        PixelPlanes<float> first(kRows * kStride + kLanePadding);
        std::vector<RowOutcome> expected(kRows);
        for (int i = 0; i < 30; ++i) {
            variants[0](rows, span, splat, {exact, 1}, true, first, firsts.data(), expected.data());
        }
        for (const RasteriseFunction variant : variants) {
            PixelPlanes<float> pixels(kRows * kStride + kLanePadding);
            std::vector<RowOutcome> outcomes(kRows);
            for (int i = 0; i < 30; ++i) {
                variant(rows, span, splat, {exact, 1}, true, pixels, firsts.data(),
                        outcomes.data());
            }
            for (std::size_t row = 0; row < kRows; ++row) {
                expect_same(outcomes[row], expected[row]);
            }
            for (std::size_t i = 0; i < kRows * kStride; ++i) {
                expect_same(pixels.read(i), first.read(i));
            }
        }
    }
}

} // namespace
} // namespace degs
