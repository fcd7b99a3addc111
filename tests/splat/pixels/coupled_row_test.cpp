// SPDX-License-Identifier: Apache-2.0
// Rows for an array that checks while it blends: as wide as the splat's bounding box.
#include "splat/pixels/coupled_row.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/modules/degs/workload_fixture.hpp"

namespace degs {
namespace {

using test::make_frame;
using test::random_frame;

TEST(CoupledRow, ColumnsOfTheBoxAreThoseThatTheEllipseReaches) {
    ProjectedSplat splat;
    splat.mu_x = 100.25;
    splat.cov_a = 4;
    splat.q_threshold = 9; // reach 6
    EXPECT_EQ(columns_of_box(splat).first, 95);
    EXPECT_EQ(columns_of_box(splat).last, 106);
    splat.q_threshold = 0;
    EXPECT_TRUE(columns_of_box(splat).empty()); // no pixel at 100.25
    splat.mu_x = -7;
    EXPECT_EQ(columns_of_box(splat).first, -7);
    EXPECT_EQ(columns_of_box(splat).last, -7);
    splat.cov_a = 1e300;
    splat.q_threshold = 9;
    EXPECT_EQ(columns_of_box(splat).first, -(1 << 30));
    EXPECT_EQ(columns_of_box(splat).last, 1 << 30);
}

// In every arithmetic, and cut at the tile.
TEST(CoupledRow, ARowIsThePartOfTheBoxInsideTheTile) {
    const FrameWorkload frame = random_frame(3, 96, 64, 32, 80);
    for (std::size_t n = 0; n < arithmetic_names().size(); ++n) {
        SCOPED_TRACE(arithmetic_names()[n]);
        const auto path = make_data_path(named_numbers(arithmetic_names()[n]), 32, 1);
        const std::uint32_t base = path->add_frame(frame);
        int rows = 0;
        for (std::uint32_t i = 0; i < frame.splats.size(); ++i) {
            const PixelRange box = columns_of_box(frame.splats[i]);
            const PixelRange inside = box.within({32, 63});
            const auto row = row_of_box(*path, base + i, 40, 32, 64, 32);
            ASSERT_EQ(row.has_value(), !inside.empty());
            if (row) {
                ++rows;
                EXPECT_EQ(row->splat, base + i);
                EXPECT_EQ(row->y, 8);
                EXPECT_EQ(row->x0, inside.first - 32);
                EXPECT_EQ(row->base, row->x0);
                EXPECT_EQ(row->length, inside.size());
            }
        }
        EXPECT_GT(rows, 0);
    }
}

// In double precision no pixel of a solved row lies outside the box.
TEST(CoupledRow, HoldsTheSolvedRow) {
    const FrameWorkload frame = random_frame(4, 96, 64, 32, 200);
    DataPathOptions numbers;
    numbers.numbers = Arithmetic::Fp64;
    const auto path = make_data_path(numbers, 32, 1);
    path->add_frame(frame);
    for (std::uint32_t i = 0; i < frame.splats.size(); ++i) {
        for (int y = 32; y < 64; ++y) {
            const auto solved = path->solve_row(i, y, 32, 64, 32);
            if (!solved) {
                continue;
            }
            const auto box = row_of_box(*path, i, y, 32, 64, 32);
            ASSERT_TRUE(box);
            EXPECT_LE(box->x0, solved->x0);
            EXPECT_GE(box->x0 + box->length, solved->x0 + solved->length);
        }
    }
}

TEST(CoupledRow, ATestNamesThePixelsOfItsTask) {
    BlendTask task;
    task.splat = 5;
    task.mask = 0xF0;
    task.row = 3;
    task.column = 16;
    task.context = 2;
    const PixelTest test = test_of(task, 64, 96);
    EXPECT_EQ(test.splat, 5U);
    EXPECT_EQ(test.mask, 0xF0U);
    EXPECT_EQ(test.x, 80);
    EXPECT_EQ(test.y, 99);
    EXPECT_EQ(test.row, 3);
    EXPECT_EQ(test.column, 16);
    EXPECT_EQ(test.context, 2);
}

} // namespace
} // namespace degs
