// SPDX-License-Identifier: Apache-2.0
// Where a splat may have pixels: rows, columns, and splats far away or hardly there.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/splat/pixels/data_path_fixture.hpp"

namespace degs {
namespace {

using test::make_splat;
using test::path_of;
using test::path_options;
using test::random_splat;

/// q of the nearest point of row y, in long double.
long double vertical_q(const ProjectedSplat& s, int y) {
    const long double dy = y - static_cast<long double>(s.mu_y);
    return dy * dy / s.cov_c;
}

class RowExtents : public ::testing::TestWithParam<Arithmetic> {};

// alpha = 1/255 is the largest a splat of that opacity has: its centre, if that is a pixel.
TEST_P(RowExtents, TheLeastOpacityCoversItsCentreAlone) {
    ProjectedSplat on = make_splat(20, 12, 3, 2, 0.3, 1.0 / 255);
    on.q_threshold = 0; // as projection gives it, see ProjectedSplat::q_threshold
    ProjectedSplat beside = on;
    beside.mu_x = 20.25;
    const auto path = path_of({on, beside}, path_options(GetParam()));
    for (int y = 0; y < 64; ++y) {
        EXPECT_EQ(path->solve_row(0, y, 0, 64, 0).has_value(), y == 12);
        EXPECT_FALSE(path->solve_row(1, y, 0, 64, 0));
    }
    const auto span = path->solve_row(0, 12, 0, 64, 0);
    ASSERT_TRUE(span);
    EXPECT_EQ(span->x0, 20);
    EXPECT_EQ(span->length, 1);
    BlendTask task;
    task.g0 = span->g0;
    task.d0 = span->d0;
    task.row = 12;
    task.column = 16;
    task.offset = -4;
    task.mask = 1U << 4U;
    EXPECT_EQ(path->blend(task).useful, 1U << 4U); // alpha >= 1/255, not just below it
}

TEST_P(RowExtents, FarAwaySplatsMissAndNeverLeaveTheTile) {
    std::vector<ProjectedSplat> splats;
    for (const double far : {1e3, 1e5, 1e7, 3e7, 1e9, 1e12, 1e300}) {
        for (const double sign : {-1.0, 1.0}) {
            splats.push_back(make_splat(sign * far, 10, 5, 5, 0, 1));
            splats.push_back(make_splat(10, sign * far, 5, 5, 0, 1));
        }
    }
    const auto path = path_of(splats, path_options(GetParam()));
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        path->rows(i);
        for (int y = 0; y < 64; ++y) {
            ASSERT_FALSE(path->solve_row(i, y, 0, 64, 0)) << i << ", row " << y;
        }
    }
}

// Giants whose centre is so far off that a float cannot name single pixels any more.
TEST_P(RowExtents, GiantsFarAwayStayInsideTheTile) {
    std::vector<ProjectedSplat> splats;
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(0.2, 1);
    for (int i = 0; i < 400; ++i) {
        const double far = std::pow(10.0, 6 + 3.5 * unit(random)) * (i % 2 == 0 ? 1 : -1);
        splats.push_back(make_splat(far + unit(random), 10 + unit(random),
                                    std::abs(far) / 3 * unit(random) * 1.3, 20, 1e-9, 1));
    }
    for (const SpanEnds ends : {SpanEnds::Exact, SpanEnds::Outward}) {
        const auto path = path_of(splats, path_options(GetParam(), ends));
        int spans = 0;
        for (std::uint32_t i = 0; i < splats.size(); ++i) {
            for (int y = 0; y < 64; y += 7) {
                if (const auto span = path->solve_row(i, y, 17, 17 + 45, 0)) {
                    ++spans;
                    ASSERT_GE(span->x0, 0) << i;
                    ASSERT_GE(span->length, 1) << i;
                    ASSERT_LE(span->x0 + span->length, 45) << i;
                }
            }
        }
        EXPECT_GT(spans, 100);
    }
}

// Rows, columns and lengths of the largest tile fit their 16 bits.
TEST_P(RowExtents, TheLargestTile) {
    const auto path =
        path_of({make_splat(512, 512, 2000, 2000, 0, 1)}, path_options(GetParam()), 1024);
    const auto span = path->solve_row(0, 1023, 0, 1024, 0);
    ASSERT_TRUE(span);
    EXPECT_EQ(span->y, 1023);
    EXPECT_EQ(span->x0, 0);
    EXPECT_EQ(span->length, 1024);
    BlendTask task;
    task.row = 1023;
    task.column = 992;
    task.offset = 992;
    task.mask = ~0U;
    task.g0 = span->g0;
    task.d0 = span->d0;
    EXPECT_EQ(path->blend(task).useful, ~0U);
    std::vector<PixelValue> row(1024);
    path->read_row(0, 1023, 1024, row.data());
    EXPECT_EQ(row[991].updates, 0U);
    EXPECT_EQ(row[1023].updates, 1U);
}

// Rows whose nearest point of the ellipse is inside: dy^2 / c <= Q_th.
TEST_P(RowExtents, RowsAreThoseThatTheEllipseMeets) {
    std::mt19937 random(5);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 2000; ++i) {
        splats.push_back(random_splat(random, 100, 100, 64));
    }
    const auto path = path_of(splats, path_options(GetParam()));
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        const PixelRange rows = path->rows(i);
        for (const int y : {rows.first - 1, rows.first, rows.last, rows.last + 1}) {
            const long double room = splats[i].q_end() - vertical_q(splats[i], y);
            if (std::abs(room) > 1e-9 && !rows.empty()) {
                EXPECT_EQ(room > 0, rows.holds(y)) << i << ", row " << y;
            }
        }
    }
}

// No span leaves the columns of its splat, however its ends are rounded; and they are not far from
// the ellipse's own box.
TEST_P(RowExtents, ColumnsHoldEverySpan) {
    std::mt19937 random(8);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 2000; ++i) {
        splats.push_back(random_splat(random, 100, 100, 64));
    }
    for (const int delta : {0, 2}) {
        const auto path = path_of(splats, path_options(GetParam(), SpanEnds::Outward, delta));
        for (std::uint32_t i = 0; i < splats.size(); ++i) {
            const PixelRange columns = path->columns(i);
            const double reach = std::sqrt(splats[i].q_threshold * splats[i].cov_a) + delta;
            EXPECT_GE(columns.first, splats[i].mu_x - reach - 4) << i;
            EXPECT_LE(columns.last, splats[i].mu_x + reach + 4) << i;
            for (int y = 80; y < 180; ++y) {
                if (const auto span = path->solve_row(i, y, -400, 600, 0)) {
                    ASSERT_GE(span->x0 - 400, columns.first) << i << ", row " << y;
                    ASSERT_LE(span->x0 - 400 + span->length - 1, columns.last)
                        << i << ", row " << y;
                }
            }
        }
    }
}

// Every covered pixel lies in the rows named for its columns, needles included; half of the
// splats just touch the first or the last column, where rounding decides most.
TEST_P(RowExtents, RowsInColumnsNeverMissAPixel) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<ProjectedSplat> splats;
    std::vector<std::pair<int, int>> columns;
    for (int i = 0; i < 20000; ++i) {
        ProjectedSplat s = random_splat(random, 1000, 500, 64);
        const int x_begin = 1000 + static_cast<int>(random() % 60);
        const int x_end = x_begin + 1 + static_cast<int>(random() % 40);
        const double touch = std::pow(10.0, -9 * unit(random)); // px beyond the column
        const double reach = std::sqrt(s.q_threshold * s.cov_a);
        if (i % 4 == 0) {
            s.mu_x = x_begin + touch - reach;
        } else if (i % 4 == 1) {
            s.mu_x = x_end - 1 - touch + reach;
        }
        if (i % 2 == 0) { // where it touches
            s.mu_y = 520.3 + (s.mu_x < x_begin ? -1 : 1) * s.cov_b / s.cov_a * reach;
        }
        splats.push_back(s);
        columns.emplace_back(x_begin, x_end);
    }
    const auto path = path_of(splats, path_options(GetParam()));
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        const PixelRange rows = path->rows_in_columns(i, columns[i].first, columns[i].second);
        for (int y = 470; y < 570; ++y) {
            if (path->solve_row(i, y, columns[i].first, columns[i].second, 470)) {
                ASSERT_TRUE(rows.holds(y)) << "splat " << i << ", row " << y << " is not in "
                                           << rows.first << " .. " << rows.last;
            }
        }
    }
}

// For splats that are no needles, at most a row is named in vain at either end.
TEST_P(RowExtents, RowsInColumnsAreTight) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 2000; ++i) {
        splats.push_back(make_splat(100 + 64 * unit(random), 100 + 64 * unit(random),
                                    1 + 20 * unit(random), 1 + 5 * unit(random), 6.3 * unit(random),
                                    0.02 + 0.98 * unit(random)));
    }
    const auto path = path_of(splats, path_options(GetParam()));
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        const ProjectedSplat& s = splats[i];
        const int x_begin = 100 + static_cast<int>(random() % 64);
        const int x_end = x_begin + 2 + static_cast<int>(random() % 30);
        const PixelRange rows = path->rows_in_columns(i, x_begin, x_end);
        // The ellipse between the columns, sampled: its lowest and highest y.
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (double x = x_begin; x <= x_end - 1; x += 1.0 / 64) {
            const double dx = x - s.mu_x;
            const double room = (s.q_threshold - dx * dx / s.cov_a) * s.det / s.cov_a;
            if (room >= 0) {
                const double y = s.mu_y + s.cov_b / s.cov_a * dx;
                low = std::min(low, y - std::sqrt(room));
                high = std::max(high, y + std::sqrt(room));
            }
        }
        if (low <= high) {
            EXPECT_GE(rows.first, std::ceil(low) - 1) << i;
            EXPECT_LE(rows.last, std::floor(high) + 1) << i;
        } else {
            EXPECT_LE(rows.last - rows.first, 2) << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, RowExtents, ::testing::Values(Arithmetic::Fp64, Arithmetic::Fp32),
                         [](const auto& format) {
                             return format.param == Arithmetic::Fp64 ? "Fp64" : "Fp32";
                         });

} // namespace
} // namespace degs
