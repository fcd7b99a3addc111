// SPDX-License-Identifier: Apache-2.0
// DataPath::tested_columns names exactly the pixels that DataPath::test finds inside.
#include "tests/splat/pixels/data_path_fixture.hpp"

namespace degs {
namespace {

using test::make_splat;
using test::path_of;
using test::path_options;
using test::random_splat;

constexpr int kTestedTile = 32;

/// In and around the tile whose first pixel is (corner, corner / 2).
std::vector<ProjectedSplat> splats_at(int corner, std::mt19937& random) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 400; ++i) {
        splats.push_back(random_splat(random, corner, corner / 2, kTestedTile));
    }
    return splats;
}

/// The row as test() sees it on pixels that no splat has touched.
std::uint32_t tested(DataPath& path, std::uint32_t splat, int x, int y) {
    path.begin_row(0, 0);
    PixelTest test;
    test.splat = splat;
    test.mask = ~0U;
    test.x = x;
    test.y = y;
    return ~path.test(test).boundary;
}

std::uint32_t named(const DataPath& path, std::uint32_t splat, int x, int y, int width) {
    const PixelRange columns = path.tested_columns(splat, y, x, x + width);
    if (columns.empty()) {
        return 0;
    }
    EXPECT_LE(x, columns.first);
    EXPECT_LT(columns.last, x + width);
    std::uint32_t mask = 0;
    for (int i = columns.first; i <= columns.last; ++i) {
        mask |= 1U << (i - x);
    }
    return mask;
}

class TestedColumns : public ::testing::TestWithParam<Arithmetic> {};

// Far corners too, where float names pixels by the dozen only.
TEST_P(TestedColumns, AreThoseThatPassTheTest) {
    std::mt19937 random(31);
    const int corners[] = {0, 7, 1900, 40'000, 20'000'000};
    int covered = 0;
    for (const int corner : corners) {
        const std::vector<ProjectedSplat> splats = splats_at(corner, random);
        const auto path = path_of(splats, path_options(GetParam()), kTestedTile);
        for (std::uint32_t i = 0; i < splats.size(); ++i) {
            for (int y = corner / 2; y < corner / 2 + kTestedTile; ++y) {
                const std::uint32_t pixels = tested(*path, i, corner, y);
                ASSERT_EQ(named(*path, i, corner, y, kTestedTile), pixels) << corner << " " << i;
                ASSERT_EQ(named(*path, i, corner, y, 5), pixels & 31U);
                covered += __builtin_popcount(pixels);
            }
        }
    }
    EXPECT_GT(covered, 100'000);
}

// No row with a pixel that passes is left out, whatever part of the tile is asked for; of whole
// splats in double precision, hardly any without one is named.
TEST_P(TestedColumns, LieInTheTestedRows) {
    std::mt19937 random(32);
    const int corners[] = {0, 1900, 40'000, 20'000'000};
    int named_rows = 0, needed_rows = 0;
    for (const int corner : corners) {
        const std::vector<ProjectedSplat> splats = splats_at(corner, random);
        const auto path = path_of(splats, path_options(GetParam()), kTestedTile);
        for (std::uint32_t i = 0; i < splats.size(); ++i) {
            const int width = i % 3 == 0 ? 1 + static_cast<int>(random() % kTestedTile) : 32;
            const int y0 = corner / 2 + static_cast<int>(random() % 8);
            const PixelRange area{y0, corner / 2 + kTestedTile - 1};
            const PixelRange rows = path->tested_rows(i, {corner, corner + width - 1}, area);
            named_rows += rows.size();
            for (int y = area.first; y <= area.last; ++y) {
                if (named(*path, i, corner, y, width) != 0) {
                    ASSERT_TRUE(rows.holds(y)) << corner << " " << i;
                    ++needed_rows;
                }
            }
            ASSERT_TRUE(rows.empty() || (area.holds(rows.first) && area.holds(rows.last)));
        }
    }
    EXPECT_GT(needed_rows, 5'000);
    if (GetParam() == Arithmetic::Fp64) {
        EXPECT_LT(named_rows, 1.1 * needed_rows);
    }
}

// Pixels exactly on the rim, where one rounding decides.
TEST_P(TestedColumns, OnTheRim) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 200; ++i) {
        ProjectedSplat s = make_splat(16, 16, 1, 1, 0, 0.9);
        const double reach = 1 + 0.05 * i;
        s.cov_a = s.cov_c = reach * reach / s.q_threshold; // pixel 16 + reach is on the rim
        s.det = s.cov_a * s.cov_c;
        splats.push_back(s);
    }
    const auto path = path_of(splats, path_options(GetParam()), kTestedTile);
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        for (int y = 0; y < kTestedTile; ++y) {
            ASSERT_EQ(named(*path, i, 0, y, kTestedTile), tested(*path, i, 0, y)) << i << " " << y;
        }
    }
}

// Ends as close to a pixel as rounding reaches, with little and much room below the limit.
TEST_P(TestedColumns, EndsNextToAPixel) {
    std::mt19937 random(33);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 20'000; ++i) {
        const double room = std::exp(-14 + 16 * unit(random));
        const double beyond = (i % 2 == 0 ? 1 : -1) * std::exp2(-30 + 25 * unit(random));
        ProjectedSplat s = make_splat(15.5 + unit(random), 16, 1, 1, 0, std::exp(room / 2) / 255);
        const double reach = 17 + i % 14 + beyond - s.mu_x; // of row 16
        s.cov_a = reach * reach / s.q_threshold;
        s.det = s.cov_a * s.cov_c;
        splats.push_back(s);
    }
    const auto path = path_of(splats, path_options(GetParam()), kTestedTile);
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        ASSERT_EQ(named(*path, i, 0, 16, kTestedTile), tested(*path, i, 0, 16)) << i;
    }
}

// No columns asked for, and a splat that no number describes.
TEST_P(TestedColumns, NothingToName) {
    ProjectedSplat broken = make_splat(3, 3, 1, 1, 0, 0.5);
    broken.cov_b = std::nan("");
    const auto path =
        path_of({make_splat(3, 3, 2, 2, 0, 0.5), broken}, path_options(GetParam()), kTestedTile);
    EXPECT_TRUE(path->tested_columns(0, 3, 5, 5).empty());
    EXPECT_TRUE(path->tested_columns(1, 3, 0, kTestedTile).empty());
    EXPECT_FALSE(path->tested_columns(0, 3, 0, kTestedTile).empty());
    const PixelRange columns{0, kTestedTile - 1};
    EXPECT_TRUE(path->tested_rows(0, columns, {20, kTestedTile - 1}).empty());
    EXPECT_TRUE(path->tested_rows(0, columns, {3, 2}).empty());
}

std::string format_name(const ::testing::TestParamInfo<Arithmetic>& row) {
    constexpr const char* kNames[] = {"Fp32", "Fp64", "Fp16", "Paper", "Tuned"};
    return kNames[row.index];
}

INSTANTIATE_TEST_SUITE_P(Formats, TestedColumns,
                         ::testing::Values(Arithmetic::Fp32, Arithmetic::Fp64, Arithmetic::Fp16,
                                           Arithmetic::Paper, Arithmetic::Tuned),
                         format_name);

} // namespace
} // namespace degs
