// SPDX-License-Identifier: Apache-2.0
// The traversal of GCC against a flood fill that is written down as the rule reads: pixel by pixel.
#include "baselines/gcc/traversal.hpp"

#include <deque>
#include <set>

#include "tests/splat/pixels/data_path_fixture.hpp"

namespace degs {
namespace {

using test::path_of;
using test::path_options;
using test::random_splat;

constexpr int kView = 48;

using Place = std::pair<int, int>; // row, column of windows

JobTile view_of(int x, int y, int width, int height) {
    JobTile view;
    view.x = x;
    view.y = y;
    view.width = width;
    view.height = height;
    return view;
}

/// Valid pixels of a view, one by one, on pixels that no splat has touched.
class Pixels {
public:
    Pixels(DataPath& path, std::uint32_t splat, const JobTile& view) : view_(view) {
        test::begin_tile(path, 0, kView);
        for (int y = 0; y < view.height; ++y) {
            for (int x = 0; x < view.width; ++x) {
                PixelTest test;
                test.splat = splat;
                test.mask = 1;
                test.x = view.x + x;
                test.y = view.y + y;
                test.row = static_cast<std::int16_t>(y);
                test.column = static_cast<std::int16_t>(x);
                valid_.push_back(path.test(test).boundary == 0);
            }
        }
    }
    bool valid(int x, int y) const {
        return x >= 0 && y >= 0 && x < view_.width && y < view_.height &&
               valid_[static_cast<std::size_t>(y * view_.width + x)];
    }
    /// Any valid pixel among columns x0 .. x1 and rows y0 .. y1.
    bool any(int x0, int y0, int x1, int y1) const {
        for (int y = y0; y <= y1; ++y) {
            for (int x = x0; x <= x1; ++x) {
                if (valid(x, y)) {
                    return true;
                }
            }
        }
        return false;
    }

private:
    JobTile view_;
    std::vector<bool> valid_;
};

/// The rule, literally: frontier, visited, pop, push across valid borders, seed again.
std::vector<Place> flood(const Pixels& pixels, const JobTile& view, int side, Place seed,
                         int& seeds) {
    const int columns = (view.width + side - 1) / side;
    const int rows = (view.height + side - 1) / side;
    std::vector<Place> order;
    std::set<Place> known{seed};
    std::deque<Place> frontier{seed};
    seeds = 1;
    for (;;) {
        while (!frontier.empty()) {
            const auto [row, column] = frontier.front();
            frontier.pop_front();
            order.emplace_back(row, column);
            const int x0 = column * side, y0 = row * side, x1 = x0 + side - 1, y1 = y0 + side - 1;
            const auto push = [&](int r, int c, bool leads) {
                if (leads && r >= 0 && c >= 0 && r < rows && c < columns &&
                    known.insert({r, c}).second) {
                    frontier.emplace_back(r, c);
                }
            };
            push(row, column - 1, pixels.any(x0, y0, x0, y1));
            push(row, column + 1, pixels.any(x1, y0, x1, y1));
            push(row - 1, column, pixels.any(x0, y0, x1, y0));
            push(row + 1, column, pixels.any(x0, y1, x1, y1));
        }
        for (int w = 0; w < rows * columns && frontier.empty(); ++w) {
            const Place place{w / columns, w % columns};
            const int x0 = place.second * side, y0 = place.first * side;
            if (known.count(place) == 0 && pixels.any(x0, y0, x0 + side - 1, y0 + side - 1)) {
                frontier.push_back(place);
                known.insert(place);
                ++seeds;
            }
        }
        if (frontier.empty()) {
            return order;
        }
    }
}

std::vector<Place> traverse(gcc::Traversal& traversal, const gcc::Footprint& footprint,
                            const JobTile& view, Place seed, int& seeds) {
    const int side = footprint.side();
    std::vector<Place> order;
    traversal.begin(footprint, {0, (view.width - 1) / side}, {0, (view.height - 1) / side});
    seeds = 0;
    std::optional<gcc::Traversal::Window> start{{seed.first, seed.second}};
    for (; start; start = traversal.find_missed()) {
        traversal.seed(*start);
        ++seeds;
        while (const auto window = traversal.next()) {
            order.emplace_back(window->row, window->column);
            traversal.expand(*window, 0);
        }
    }
    return order;
}

class GccTraversalWindows : public ::testing::TestWithParam<int> {};

// Same windows in the same order, for splats of any shape and views that the image cuts off.
TEST_P(GccTraversalWindows, AreThoseOfALiteralFloodFill) {
    const int side = GetParam();
    std::mt19937 random(41);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 1500; ++i) {
        splats.push_back(random_splat(random, 0, 0, kView));
    }
    const auto path = path_of(splats, path_options(Arithmetic::Fp32), kView);
    gcc::Footprint footprint(kView, side);
    gcc::Traversal traversal((kView + side - 1) / side);
    std::size_t visited = 0;
    int again = 0;
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        const bool partial = i % 3 == 0;
        const JobTile view = view_of(0, 0, partial ? 1 + static_cast<int>(random() % kView) : kView,
                                     partial ? 1 + static_cast<int>(random() % kView) : kView);
        const Pixels pixels(*path, i, view);
        footprint.solve(*path, i, view);
        const Place seed{static_cast<int>(random()) % ((view.height + side - 1) / side),
                         static_cast<int>(random()) % ((view.width + side - 1) / side)};
        const Place start{std::abs(seed.first), std::abs(seed.second)};
        int expected_seeds = 0;
        int seeds = 0;
        const auto expected = flood(pixels, view, side, start, expected_seeds);
        ASSERT_EQ(traverse(traversal, footprint, view, start, seeds), expected) << i;
        ASSERT_EQ(seeds, expected_seeds) << i;
        visited += expected.size();
        again += seeds - 1;
    }
    EXPECT_GT(visited, splats.size());
    EXPECT_GT(again, 100);
}

INSTANTIATE_TEST_SUITE_P(Sides, GccTraversalWindows, ::testing::Values(4, 8, 16, 32, 1, 5));

// The rows are the valid pixels, wherever the view lies.
TEST(GccFootprint, RowsAndWindowsHoldTheValidPixels) {
    std::mt19937 random(42);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 500; ++i) {
        splats.push_back(random_splat(random, 900, 500, kView));
    }
    const auto path = path_of(splats, path_options(Arithmetic::Fp64), kView);
    const JobTile view = view_of(900, 500, kView, kView - 5);
    gcc::Footprint footprint(kView, 8);
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        const Pixels pixels(*path, i, view);
        footprint.solve(*path, i, view);
        std::vector<bool> named(kView * kView, false);
        for (const gcc::Footprint::Row& row : footprint.rows()) {
            for (int x = row.columns.first; x <= row.columns.last; ++x) {
                named[static_cast<std::size_t>(row.y * kView + x)] = true;
            }
        }
        for (int p = 0; p < kView * kView; ++p) {
            ASSERT_EQ(named[static_cast<std::size_t>(p)], pixels.valid(p % kView, p / kView));
        }
        for (int w = 0; w < 36; ++w) {
            const int x = w % 6 * 8;
            const int y = w / 6 * 8;
            ASSERT_EQ((footprint.valid(w / 6) >> (w % 6) & 1U) != 0,
                      pixels.any(x, y, x + 7, y + 7));
        }
    }
}

TEST(GccFootprint, SixtyFourWindowsInARow) {
    EXPECT_EQ(gcc::windows_between(0, 63), ~gcc::WindowMask{0});
    EXPECT_EQ(gcc::windows_between(63, 63), gcc::WindowMask{1} << 63);
    EXPECT_EQ(gcc::windows_between(2, 3), gcc::WindowMask{12});
}

} // namespace
} // namespace degs
