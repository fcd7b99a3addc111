// SPDX-License-Identifier: Apache-2.0
#include "sim/sampling/regression.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace degs::sim {
namespace {

TEST(StudentT, HasTheTabulatedQuantiles) {
    // Fisher and Yates, Statistical Tables, two-sided 5 %.
    EXPECT_NEAR(student_t(1), 12.706, 0.001);
    EXPECT_NEAR(student_t(2), 4.303, 0.001);
    EXPECT_NEAR(student_t(3), 3.182, 0.004);
    EXPECT_NEAR(student_t(5), 2.571, 0.001);
    EXPECT_NEAR(student_t(10), 2.228, 0.001);
    EXPECT_NEAR(student_t(30), 2.042, 0.001);
    EXPECT_NEAR(student_t(1000000), 1.960, 0.001);
    EXPECT_TRUE(std::isinf(student_t(0)));
    // Two-sided 2 % and 1 %.
    EXPECT_NEAR(student_t(1, 0.98), 31.821, 0.01);
    EXPECT_NEAR(student_t(2, 0.98), 6.965, 0.001);
    EXPECT_NEAR(student_t(10, 0.98), 2.764, 0.002);
    EXPECT_NEAR(student_t(60, 0.98), 2.390, 0.001);
    EXPECT_NEAR(student_t(1000000, 0.99), 2.576, 0.001);
}

/// Blocks whose sizes differ, the same ones for the same seed.
std::vector<TileWork> population(std::size_t count, unsigned seed) {
    std::mt19937 draw(seed);
    std::lognormal_distribution<double> size(0, 0.5);
    std::vector<TileWork> blocks;
    for (std::size_t i = 0; i < count; ++i) {
        const double walked = 100 * size(draw), rows = walked * (2 + size(draw));
        const double fragments = rows * (3 + size(draw));
        blocks.push_back({2, 2048, walked * 1.5, walked, rows, fragments * 1.2, fragments, 0});
    }
    return blocks;
}

double price(const TileWork& work) {
    return 40 * work.tiles + 0.3 * work.rows + 0.02 * work.fragments;
}

TEST(RegressionEstimator, IsExactWhereTheSizesExplainEverything) {
    const std::vector<TileWork> blocks = population(300, 1);
    RegressionEstimator estimator(blocks);
    double total = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        total += price(blocks[i]);
        if (i % 5 == 0) {
            estimator.add(i, i % 7, {price(blocks[i])});
        }
    }
    const Estimate estimate = estimator.total(0);
    EXPECT_NEAR(estimate.value, total, 1e-4 * total);
    EXPECT_LT(estimate.half_width, 1e-3 * total);
    EXPECT_NEAR(estimator.total_without(0, 3), total, 1e-3 * total);
}

// Equal sizes leave the mean: total = N mean, and each block is the distance to the mean of the
// others away from it, n / (n - 1) times that to the mean of all.
TEST(RegressionEstimator, IsTheExpansionEstimatorForEqualSizes) {
    const std::vector<TileWork> blocks(40, TileWork{1, 16, 5, 5, 4, 8, 8, 9});
    RegressionEstimator estimator(blocks);
    const std::vector<double> values{3, 5, 4, 8, 1, 6};
    for (std::size_t i = 0; i < values.size(); ++i) {
        estimator.add(7 * i % 40, i, {values[i]});
    }
    const double n = 6, mean = 27.0 / 6;
    double squares = 0;
    for (const double value : values) {
        squares += (value - mean) * (value - mean) * (n / (n - 1)) * (n / (n - 1));
    }
    const double error = 40 * std::sqrt(squares / n * (1 - n / 40) / n);
    EXPECT_NEAR(estimator.total(0).value, 40 * mean, 1e-4);
    EXPECT_NEAR(estimator.total(0).half_width, student_t(5) * error, 1e-3 * error);
    EXPECT_NEAR(estimator.total_without(0, 3), 40 * (27.0 - 8) / 5, 1e-3);
}

// Sixteen blocks are fitted to two sizes: weighted least squares by hand, and the t quantile of
// 16 - 2 degrees of freedom.
TEST(RegressionEstimator, LosesADegreeOfFreedomWithEachSize) {
    constexpr std::size_t kAll = 160, kSeen = 16;
    std::mt19937 draw(5);
    std::uniform_real_distribution<double> size(0.5, 1.5);
    std::vector<TileWork> blocks(kAll, TileWork{0, 0, 0, 0, 0, 0, 0, 0});
    double cycles = 0, fragments = 0;
    for (TileWork& block : blocks) {
        block.cycles = size(draw);
        block.fragments = size(draw);
        cycles += block.cycles / kAll;
        fragments += block.fragments / kAll;
    }
    RegressionEstimator estimator(blocks);
    struct Row {
        double a, b, weight, y;
    };
    std::vector<Row> rows;
    double aa = 0, ab = 0, bb = 0, ay = 0, by = 0;
    for (std::size_t i = 0; i < kSeen; ++i) {
        const double y = size(draw);
        const double a = blocks[i].cycles / cycles, b = blocks[i].fragments / fragments;
        estimator.add(i, i, {y});
        rows.push_back({a, b, 1 / (0.1 + b), y});
        aa += rows[i].weight * a * a;
        ab += rows[i].weight * a * b;
        bb += rows[i].weight * b * b;
        ay += rows[i].weight * a * y;
        by += rows[i].weight * b * y;
    }
    const double det = aa * bb - ab * ab;
    double squares = 0;
    for (const Row& row : rows) {
        const double fitted = (row.a * (bb * ay - ab * by) + row.b * (aa * by - ab * ay)) / det;
        const double leverage =
            row.weight * (row.a * row.a * bb - 2 * row.a * row.b * ab + row.b * row.b * aa) / det;
        squares += std::pow((row.y - fitted) / (1 - leverage), 2);
    }
    const double n = kSeen, all = kAll;
    const double error = all * std::sqrt(squares / n * (1 - n / all) / n);
    EXPECT_NEAR(estimator.total(0).half_width, student_t(kSeen - 2) * error, 1e-4 * error);
}

TEST(RegressionEstimator, KnowsWhatItHasSeenWhole) {
    const std::vector<TileWork> blocks = population(30, 2);
    RegressionEstimator estimator(blocks);
    double total = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const double value = price(blocks[i]) * (i % 3 == 0 ? 2.0 : 1.0);
        total += value;
        estimator.add(i, 0, {value});
    }
    EXPECT_NEAR(estimator.total(0).value, total, 1e-9 * total);
    EXPECT_EQ(estimator.total(0).half_width, 0);
}

TEST(RegressionEstimator, PromisesNothingFromOneBlock) {
    RegressionEstimator estimator(population(30, 3));
    estimator.add(4, 0, {100});
    EXPECT_TRUE(std::isinf(estimator.total(0).half_width));
}

/// How often the interval of a random sample holds the total of a population with such a noise.
template <class Noise>
double coverage(std::size_t sample, Noise noise) {
    constexpr int kDraws = 1000;
    int inside = 0;
    std::mt19937 draw(11);
    const std::vector<TileWork> blocks = population(500, 4);
    std::vector<double> values;
    for (const TileWork& block : blocks) {
        values.push_back(price(block) * noise(draw));
    }
    const double total = std::accumulate(values.begin(), values.end(), 0.0);
    std::vector<std::size_t> order(blocks.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (int i = 0; i < kDraws; ++i) {
        std::shuffle(order.begin(), order.end(), draw);
        RegressionEstimator estimator(blocks);
        for (std::size_t b = 0; b < sample; ++b) {
            estimator.add(order[b], b / 4, {values[order[b]]});
        }
        const Estimate estimate = estimator.total(0);
        inside += std::abs(estimate.value - total) <= estimate.half_width ? 1 : 0;
    }
    return inside / double{kDraws};
}

TEST(RegressionEstimator, CoversNormalNoise) {
    const double share = coverage(60, std::normal_distribution<double>(1, 0.15));
    EXPECT_GE(share, 0.93);
    EXPECT_LE(share, 0.99) << "wider than it need be";
}

TEST(RegressionEstimator, CoversAHeavyTail) {
    EXPECT_GE(coverage(100, std::lognormal_distribution<double>(0, 0.5)), 0.93);
}

} // namespace
} // namespace degs::sim
