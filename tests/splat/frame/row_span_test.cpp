// SPDX-License-Identifier: Apache-2.0
// The ends and the start values of row spans, against brute force over pixels.
#include <algorithm>
#include <random>

#include "tests/splat/pixels/data_path_fixture.hpp"

namespace degs {
namespace {

using test::exact_q;
using test::path_of;
using test::path_options;
using test::random_splat;

constexpr double kDoubleSlack = 1e-9; ///< of q; far above the rounding of doubles
constexpr double kFloatEps = 0x1p-24;

/// One row of a splat in long double.
struct Row {
    long double centre, half_width, vertical; ///< half_width < 0: the ellipse misses the row
    Row(const ProjectedSplat& s, int y) {
        const long double dy = y - static_cast<long double>(s.mu_y);
        vertical = dy * dy / s.cov_c;
        centre = s.mu_x + static_cast<long double>(s.cov_b) / s.cov_c * dy;
        const long double room = s.q_threshold - vertical;
        half_width = room < 0 ? -1 : std::sqrt(room * s.det / s.cov_c);
    }
};

/// How far a float data path may be off in q at pixel distance |x - centre| <= reach of a row.
/// With A = c/det, W = reach: the centre is m dy plus two offsets, each operation rounded once, so
/// its error is Dc <= eps (4 |m dy| + 2 W + 2); q = A (x - c)^2 + C' dy^2 then moves by
/// 2 A W Dc + A Dc^2, and its own roundings cost at most 10 eps (A W^2 + C' dy^2 + Q_th + 12), the
/// 12 for 2 ln o.
long double float_slack(const ProjectedSplat& s, const Row& row, int y, long double reach) {
    const long double a = s.cov_c / s.det;
    const long double shear = std::abs(s.cov_b / s.cov_c * (y - s.mu_y));
    const long double centre_error = kFloatEps * (4 * shear + 2 * reach + 2);
    return 2 * a * reach * centre_error + a * centre_error * centre_error +
           10 * kFloatEps * (a * reach * reach + row.vertical + s.q_threshold + 12);
}

struct Tile {
    int x = 0, y = 0, width = 0, height = 0;
};

/// Pixels of one row of the tile: by brute force inside, outside, or too close to tell.
void expect_row_is_brute_force(const DataPath& path, std::uint32_t index, const ProjectedSplat& s,
                               const Tile& tile, int y, bool single) {
    const auto span = path.solve_row(index, y, tile.x, tile.x + tile.width, tile.y);
    const Row row(s, y);
    int inside = 0;
    for (int x = 0; x < tile.width; ++x) {
        const bool covered = span && x >= span->x0 && x < span->x0 + span->length;
        const long double q = exact_q(s, tile.x + x, y);
        const long double reach = std::abs(tile.x + x - row.centre);
        const long double slack = single ? float_slack(s, row, y, reach) : kDoubleSlack;
        if (std::abs(q - s.q_threshold) > slack) {
            const long double alpha = s.opacity * std::exp(-q / 2);
            ASSERT_EQ(covered, s.q_cut_off > 0 ? q <= s.q_threshold : alpha >= 1.0L / 255)
                << "pixel " << tile.x + x << ", " << y << ", q - Q_th = " << q - s.q_threshold;
        }
        inside += covered ? 1 : 0;
    }
    ASSERT_EQ(span.has_value(), inside > 0);
    if (span) {
        EXPECT_EQ(inside, span->length); // all of it inside the tile
        EXPECT_EQ(span->y, y - tile.y);
        EXPECT_EQ(span->splat, index);
    }
}

class RowSpans : public ::testing::TestWithParam<Arithmetic> {};

TEST_P(RowSpans, ExactEndsAreThePixelsOfTheEllipse) {
    std::mt19937 random(1);
    std::vector<ProjectedSplat> splats;
    const Tile tile{1920, 1024, 64, 50};
    for (int i = 0; i < 800; ++i) {
        splats.push_back(random_splat(random, tile.x, tile.y, tile.width));
    }
    const auto path = path_of(splats, path_options(GetParam()));
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        SCOPED_TRACE(i);
        for (int y = tile.y; y < tile.y + tile.height; ++y) {
            expect_row_is_brute_force(*path, i, splats[i], tile, y, GetParam() == Arithmetic::Fp32);
        }
    }
}

// floor(x_c - w) - delta .. ceil(x_c + w) + delta, cut at the tile.
TEST_P(RowSpans, OutwardEndsAreWhatTheFormulaSays) {
    std::mt19937 random(2);
    const Tile tile{640, 320, 64, 64};
    const bool single = GetParam() == Arithmetic::Fp32;
    for (const int delta : {0, 1, 3}) {
        std::vector<ProjectedSplat> splats;
        for (int i = 0; i < 300; ++i) {
            splats.push_back(random_splat(random, tile.x, tile.y, tile.width));
        }
        const auto path = path_of(splats, path_options(GetParam(), SpanEnds::Outward, delta));
        int spans = 0;
        for (std::uint32_t i = 0; i < splats.size(); ++i) {
            for (int y = tile.y; y < tile.y + tile.height; ++y) {
                const Row row(splats[i], y);
                const long double room = splats[i].q_threshold - row.vertical;
                const long double reach = std::max(row.half_width, 0.0L);
                const long double left = row.centre - reach;
                const long double right = row.centre + reach;
                // In px: the slack of q over its slope 2 A w at the end.
                const long double slack =
                    !single ? kDoubleSlack
                            : float_slack(splats[i], row, y, reach) * splats[i].det /
                                  (splats[i].cov_c * std::max(2 * reach, 1e-6L));
                const auto close = [&](long double v) {
                    return std::abs(v - std::round(v)) <= slack;
                };
                if (close(left) || close(right) || std::abs(room) < 1e-4L) {
                    continue;
                }
                const long double x0 = std::max<long double>(std::floor(left) - delta, tile.x);
                const long double x1 =
                    std::min<long double>(std::ceil(right) + delta, tile.x + tile.width - 1);
                const auto span = path->solve_row(i, y, tile.x, tile.x + tile.width, tile.y);
                ASSERT_EQ(span.has_value(), room >= 0 && x0 <= x1) << i << ", row " << y;
                if (span) {
                    ++spans;
                    ASSERT_EQ(span->x0, static_cast<int>(x0) - tile.x) << i << ", row " << y;
                    ASSERT_EQ(span->length, static_cast<int>(x1 - x0) + 1) << i << ", row " << y;
                }
            }
        }
        EXPECT_GT(spans, 2000);
    }
}

// g0 + n d0 + A n(n-1) is q(x0 + n) - 2 ln o: forward differences of a parabola lose nothing but
// rounding, whose bound is float_slack() with W the distance of the farther end (the three terms
// are at most 9 A W^2, hence the factor), 2^29 times less in double.
TEST_P(RowSpans, ClosedFormIsTheDirectForm) {
    std::mt19937 random(3);
    const Tile tile{300, 200, 64, 64};
    const bool single = GetParam() == Arithmetic::Fp32;
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 500; ++i) {
        splats.push_back(random_splat(random, tile.x, tile.y, tile.width));
    }
    const auto path = path_of(splats, path_options(GetParam(), SpanEnds::Outward, 1));
    double worst = 0;
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        const ProjectedSplat& s = splats[i];
        const double a = single ? static_cast<float>(s.conic_a()) : s.conic_a();
        for (int y = tile.y; y < tile.y + tile.height; ++y) {
            const auto solved = path->solve_row(i, y, tile.x, tile.x + tile.width, tile.y);
            if (!solved) {
                continue;
            }
            const RowSpan& span = *solved;
            const Row row(s, y);
            const int x0 = tile.x + span.x0;
            const long double reach =
                std::max(std::abs(x0 - row.centre), std::abs(x0 + span.length - 1 - row.centre));
            const long double slack = 9 * float_slack(s, row, y, reach) * (single ? 1 : 0x1p-29L);
            for (int n = 0; n < span.length; ++n) {
                const double closed = span.g0 + n * span.d0 + a * n * (n - 1.0);
                const long double direct = exact_q(s, x0 + n, y) - 2 * std::log(s.opacity);
                const auto error = static_cast<double>(std::abs(closed - direct) / slack);
                worst = std::max(worst, error);
                ASSERT_LE(error, 1.0) << i << ", row " << y << ", n = " << n;
            }
        }
    }
    EXPECT_GT(worst, 1e-3); // the bound means something
}

INSTANTIATE_TEST_SUITE_P(Formats, RowSpans, ::testing::Values(Arithmetic::Fp64, Arithmetic::Fp32),
                         [](const auto& format) {
                             return format.param == Arithmetic::Fp64 ? "Fp64" : "Fp32";
                         });

} // namespace
} // namespace degs
