// SPDX-License-Identifier: Apache-2.0
// Totals of a population of blocks from a random sample of them, with the help of sizes that are
// known for all of them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "splat/frame/tile_work.hpp"

namespace degs::sim {

constexpr double kConfidence = 0.95; ///< of what a sampled run says

/// Half the width of an interval of this confidence (0 .. 1) in standard errors, by Student's t
/// distribution: 1.96 for 0.95 and infinitely many degrees of freedom; infinite for none.
double student_t(std::size_t degrees_of_freedom, double confidence = kConfidence);

struct Estimate {
    double value = 0;
    double half_width = 0; ///< of the interval
    double low() const { return value - half_width; }
    double high() const { return value + half_width; }
};

/// The generalised regression estimator: what was measured is explained by the sizes of the blocks,
/// fitted to the sample; the total is that of the fitted values plus the mean residual of every
/// block. The standard error is that of the residuals, with the correction for a finite population.
class RegressionEstimator {
public:
    /// `population`: the blocks that the sample is drawn from, without replacement.
    explicit RegressionEstimator(const std::vector<TileWork>& population);

    /// A block of the sample, and the values that were measured for it: as many for every block.
    void add(std::size_t block, std::size_t group, std::vector<double> measured);
    std::size_t blocks() const { return sample_.size(); }

    /// The total of the population, with an interval of this confidence (0 .. 1), which is
    /// infinitely wide for fewer blocks than it takes.
    Estimate total(std::size_t measure, double confidence = kConfidence) const;
    /// The total of the population, estimated without the blocks of one group of the sample.
    double total_without(std::size_t measure, std::size_t group) const;

private:
    static constexpr std::size_t kTerms = 7;
    using Terms = std::array<double, kTerms>;
    struct Block {
        Terms terms;
        double weight;
        std::size_t group;
        std::vector<double> measured;
    };
    struct Fit {
        Terms slope{};
        std::size_t terms = 0, blocks = 0;
        double residuals = 0, squares = 0; ///< sums over the sample
    };
    Terms terms_of(const TileWork& work) const;
    Fit fit(std::size_t measure, std::size_t left_out) const;
    double total_of(const Fit& fit) const;

    std::vector<Terms> population_;
    Terms scale_{}, sum_{};
    std::vector<Block> sample_;
};

} // namespace degs::sim
