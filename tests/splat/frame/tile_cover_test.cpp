// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/tile_cover.hpp"

#include <set>

#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

using TileSet = std::set<std::pair<int, int>>; // row, column

TileSet tiles_of(const std::vector<TileRun>& runs, const TileGrid& grid) {
    TileSet tiles;
    for (const TileRun& run : runs) {
        EXPECT_LE(run.first, run.last);
        EXPECT_GE(run.first, 0);
        EXPECT_LT(run.last, grid.tiles_x());
        EXPECT_LT(run.row, grid.tiles_y());
        for (int column = run.first; column <= run.last; ++column) {
            EXPECT_TRUE(tiles.emplace(run.row, column).second) << "listed twice";
        }
    }
    return tiles;
}

TileSet listed_tiles(const ProjectedSplat& splat, const TileGrid& grid, TileMode mode) {
    std::vector<TileRun> runs;
    cover_tiles(splat, grid, mode, runs);
    return tiles_of(runs, grid);
}

TileSet exact_tiles(const ProjectedSplat& splat, const TileGrid& grid) {
    return listed_tiles(splat, grid, TileMode::Exact);
}

TileSet square_tiles(const ProjectedSplat& splat, const TileGrid& grid) {
    return listed_tiles(splat, grid, TileMode::Square);
}

/// Every pixel of the image against q <= Q_th, in long double and with the literal conic.
TileSet brute_tiles(const ProjectedSplat& s, const TileGrid& grid) {
    TileSet tiles;
    for (int y = 0; y <= grid.image().y1; ++y) {
        for (int x = 0; x <= grid.image().x1; ++x) {
            const long double dx = x - static_cast<long double>(s.mu_x);
            const long double dy = y - static_cast<long double>(s.mu_y);
            const long double q =
                (s.cov_c * dx * dx - 2.0L * s.cov_b * dx * dy + s.cov_a * dy * dy) / s.det;
            if (q <= s.q_threshold) {
                tiles.emplace(y / grid.tile_size(), x / grid.tile_size());
            }
        }
    }
    return tiles;
}

/// An ellipse with standard deviations `length` and `width` (px), turned by `angle`.
ProjectedSplat make_ellipse(double mu_x, double mu_y, double length, double width, double angle,
                            double q_threshold) {
    const double l = length * length, w = width * width;
    const double c = std::cos(angle), s = std::sin(angle);
    ProjectedSplat splat;
    splat.mu_x = mu_x;
    splat.mu_y = mu_y;
    splat.cov_a = l * c * c + w * s * s;
    splat.cov_b = (l - w) * c * s;
    splat.cov_c = l * s * s + w * c * c;
    splat.det = l * w;
    splat.q_threshold = q_threshold;
    return splat;
}

/// Tiles with a pixel centre within the bounding box of the ellipse q <= Q_th.
TileSet brute_tight_tiles(const ProjectedSplat& s, const TileGrid& grid) {
    const long double half_x = std::sqrt(static_cast<long double>(s.q_threshold) * s.cov_a);
    const long double half_y = std::sqrt(static_cast<long double>(s.q_threshold) * s.cov_c);
    TileSet tiles;
    for (int y = 0; y <= grid.image().y1; ++y) {
        for (int x = 0; x <= grid.image().x1; ++x) {
            if (std::abs(x - static_cast<long double>(s.mu_x)) <= half_x &&
                std::abs(y - static_cast<long double>(s.mu_y)) <= half_y) {
                tiles.emplace(y / grid.tile_size(), x / grid.tile_size());
            }
        }
    }
    return tiles;
}

/// The tiles of the reference code for a box: int() of its ends divided by the side of a tile,
/// solved for the tile. It must begin before the next tile, and reach 1 px into this one.
TileSet tiles_around(const ProjectedSplat& s, double half_x, double half_y, const TileGrid& grid) {
    const auto meets = [&](double middle, double half, int tile) {
        const double begin = tile * grid.tile_size(), end = begin + grid.tile_size();
        return middle - half < end && middle + half >= begin + 1;
    };
    TileSet tiles;
    for (int row = 0; row < grid.tiles_y(); ++row) {
        for (int column = 0; column < grid.tiles_x(); ++column) {
            if (meets(s.mu_x, half_x, column) && meets(s.mu_y, half_y, row)) {
                tiles.emplace(row, column);
            }
        }
    }
    return tiles;
}

class RandomEllipses : public testing::TestWithParam<int> {};

TEST_P(RandomEllipses, ListsAreThoseOfBruteForce) {
    std::mt19937 random(static_cast<unsigned>(GetParam()));
    std::uniform_real_distribution<double> uniform(0, 1);
    const TileGrid grid{75, 53, GetParam()};
    std::size_t listed = 0;
    for (int i = 0; i < 1500; ++i) {
        const double length = 0.2 * std::exp(6 * uniform(random));
        const double width = length * std::exp(-4 * uniform(random));
        const auto splat =
            make_ellipse(100 * uniform(random) - 12, 80 * uniform(random) - 12, length, width,
                         test::kPi * uniform(random), 11 * uniform(random));
        const TileSet expected = brute_tiles(splat, grid);
        listed += expected.size();
        ASSERT_EQ(exact_tiles(splat, grid), expected) << "ellipse " << i;
        ASSERT_EQ(listed_tiles(splat, grid, TileMode::Tight), brute_tight_tiles(splat, grid))
            << "ellipse " << i;
        ASSERT_EQ(listed_tiles(splat, grid, TileMode::Box),
                  tiles_around(splat, std::ceil(3 * std::sqrt(splat.cov_a)),
                               std::ceil(3 * std::sqrt(splat.cov_c)), grid))
            << "ellipse " << i;
        const double mid = (length * length + width * width) / 2;
        const double radius =
            std::ceil(3 * std::sqrt(std::max(length * length, mid + std::sqrt(0.1))));
        ASSERT_EQ(square_tiles(splat, grid), tiles_around(splat, radius, radius, grid))
            << "ellipse " << i;
    }
    EXPECT_GT(listed, 800U);
}

INSTANTIATE_TEST_SUITE_P(TileSizes, RandomEllipses, testing::Values(1, 3, 8, 16, 100));

// A needle thinner than the pixel grid lists single pixels with gaps between them.
TEST(TileCover, ThinEllipseLeavesGaps) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    const TileGrid grid{64, 64, 2};
    bool gap_seen = false;
    for (int i = 0; i < 2000; ++i) {
        const auto splat = make_ellipse(64 * uniform(random), 64 * uniform(random), 20, 0.05,
                                        test::kPi * uniform(random), 4);
        ASSERT_EQ(exact_tiles(splat, grid), brute_tiles(splat, grid)) << "ellipse " << i;
        std::vector<TileRun> runs;
        cover_tiles(splat, grid, TileMode::Exact, runs);
        for (std::size_t k = 1; k < runs.size(); ++k) {
            gap_seen = gap_seen || runs[k].row == runs[k - 1].row;
        }
    }
    EXPECT_TRUE(gap_seen);
}

TEST(TileCover, DiagonalNeedleDoesNotListItsBoundingBox) {
    const TileGrid grid{1024, 1024, 16};
    const auto splat = make_ellipse(512, 512, 400, 0.6, test::kPi / 4, 9);
    const std::size_t listed = exact_tiles(splat, grid).size();
    EXPECT_GE(listed, 64U); // the diagonal itself
    EXPECT_LE(listed, 3 * 64U);
}

// H7: bounded work and no overflow for a splat that covers everything.
TEST(TileCover, GiantSplatListsEveryTile) {
    const TileGrid grid{7680, 4320, 16};
    for (const double size : {1e4, 1e9, 1e60}) {
        const auto splat = make_ellipse(-1000, 9000, size, size, 0.3, 11);
        std::vector<TileRun> runs;
        cover_tiles(splat, grid, TileMode::Exact, runs);
        EXPECT_EQ(runs.size(), 270U);
        EXPECT_EQ(tiles_of(runs, grid).size(), 270U * 480U);
        cover_tiles(splat, grid, TileMode::Square, runs);
        EXPECT_EQ(tiles_of(runs, grid).size(), 270U * 480U);
    }
}

// H19: the interval test is closed; a circle of radius 8 around pixel 8 ends on pixels 0 and 16.
TEST(TileCover, EdgePixelExactlyOnTheEllipseIsListed) {
    const TileGrid grid{32, 32, 16};
    const auto splat = make_ellipse(8, 8, 4, 4, 0, 4);
    const TileSet expected{{0, 0}, {0, 1}, {1, 0}};
    EXPECT_EQ(exact_tiles(splat, grid), expected);
    const auto smaller = make_ellipse(8, 8, 4, 4, 0, 4 - 1e-5);
    EXPECT_EQ(exact_tiles(smaller, grid), (TileSet{{0, 0}}));
}

// H19: the centre on the corner of four tiles (between pixels 15 and 16) and on a pixel.
TEST(TileCover, CentreOnATileCorner) {
    const TileGrid grid{32, 32, 16};
    EXPECT_EQ(exact_tiles(make_ellipse(15.5, 15.5, 0.6, 0.6, 0, 2), grid).size(), 4U);
    EXPECT_EQ(exact_tiles(make_ellipse(15.5, 15.5, 0.3, 0.3, 0, 2), grid).size(), 0U);
    EXPECT_EQ(exact_tiles(make_ellipse(16, 16, 0.3, 0.3, 0, 2), grid), (TileSet{{1, 1}}));
}

TEST(TileCover, SinglePixelOfAThresholdSplat) {
    const TileGrid grid{33, 33, 16};
    EXPECT_EQ(exact_tiles(make_ellipse(32, 7, 5, 5, 0, 0), grid), (TileSet{{0, 2}}));
    EXPECT_TRUE(exact_tiles(make_ellipse(31.5, 7, 5, 5, 0, 0), grid).empty());
}

/// A dilated point: the variance floor makes its radius 3 px.
ProjectedSplat point_at(double x, double y) {
    return make_ellipse(x, y, std::sqrt(0.3), std::sqrt(0.3), 0, 5);
}

TEST(TileCover, SquareIsShortOnTheRightAndGenerousOnTheLeft) {
    const TileGrid grid{48, 16, 16};
    EXPECT_EQ(square_tiles(point_at(13.999, 8), grid).size(), 1U); // mu + 3 < 17
    EXPECT_EQ(square_tiles(point_at(14.0, 8), grid), (TileSet{{0, 0}, {0, 1}}));
    EXPECT_EQ(square_tiles(point_at(18.999, 8), grid), (TileSet{{0, 0}, {0, 1}})); // mu - 3 < 16
    EXPECT_EQ(square_tiles(point_at(19.0, 8), grid), (TileSet{{0, 1}}));
    const TileGrid tall{16, 48, 16};
    EXPECT_EQ(square_tiles(point_at(8, 13.999), tall).size(), 1U);
    EXPECT_EQ(square_tiles(point_at(8, 14.0), tall), (TileSet{{0, 0}, {1, 0}}));
}

TEST(TileCover, SquareAtTheBordersOfTheImage) {
    const TileGrid grid{40, 40, 16};
    EXPECT_TRUE(square_tiles(point_at(-2.001, 8), grid).empty()); // needs mu + 3 >= 1
    EXPECT_EQ(square_tiles(point_at(-2, 8), grid), (TileSet{{0, 0}}));
    EXPECT_EQ(square_tiles(point_at(50.999, 8), grid), (TileSet{{0, 2}})); // beyond the image
    EXPECT_TRUE(square_tiles(point_at(51, 8), grid).empty());
}

TEST(TileCover, SquareRadiusIsThreeSigmaOfTheLongAxis) {
    const TileGrid grid{400, 400, 1}; // one pixel per tile shows the radius itself
    for (const double angle : {0.0, 0.5, 0.785, 2.0}) {
        const auto tiles = square_tiles(make_ellipse(200, 200, 20.1, 1, angle, 1), grid);
        EXPECT_EQ(tiles.begin()->first, 200 - 61); // ceil(60.3)
        EXPECT_EQ(tiles.rbegin()->first, 200 + 61 - 1);
        EXPECT_EQ(tiles.size(), 122U * 122U);
    }
}

} // namespace
} // namespace degs
