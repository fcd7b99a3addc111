// SPDX-License-Identifier: Apache-2.0
#include "sim/sampling/regression.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace degs::sim {
namespace {

constexpr std::size_t kNobody = ~std::size_t{0};
/// Blocks of the sample for each term of the fit: more terms would fit noise.
constexpr std::size_t kBlocksPerTerm = 8;

template <std::size_t N>
using Matrix = std::array<std::array<double, N>, N>;

/// Solves a symmetric, positive definite system of `n` equations in place (Cholesky).
template <std::size_t N>
std::array<double, N> solve(Matrix<N> a, std::array<double, N> b, std::size_t n) {
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < j; ++k) {
            a[j][j] -= a[j][k] * a[j][k];
        }
        a[j][j] = std::sqrt(std::max(a[j][j], std::numeric_limits<double>::min()));
        for (std::size_t i = j + 1; i < n; ++i) {
            for (std::size_t k = 0; k < j; ++k) {
                a[i][j] -= a[i][k] * a[j][k];
            }
            a[i][j] /= a[j][j];
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            b[i] -= a[i][k] * b[k];
        }
        b[i] /= a[i][i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) {
            b[i] -= a[k][i] * b[k];
        }
        b[i] /= a[i][i];
    }
    return b;
}

/// Where the upper tail of the normal distribution is this small (0 .. 0.5), by Newton's method,
/// which comes from below because the tail is convex there.
double normal_quantile(double tail) {
    const double root_2 = std::sqrt(2.0), root_2_pi = std::sqrt(2 * std::acos(-1.0));
    double z = 0;
    for (int i = 0; i < 100; ++i) {
        const double step = (std::erfc(z / root_2) / 2 - tail) * root_2_pi * std::exp(z * z / 2);
        z += step;
        if (step < 1e-15 * z) {
            break;
        }
    }
    return z;
}

} // namespace

// Hill's expansion of the quantile (Communications of the ACM 13, 1970, algorithm 396) is within
// 4e-3 from three degrees of freedom on; the first two have closed forms.
double student_t(std::size_t degrees_of_freedom, double confidence) {
    const double both_tails = 1 - confidence; // both sides together
    const auto n = static_cast<double>(degrees_of_freedom);
    if (degrees_of_freedom == 0) {
        return std::numeric_limits<double>::infinity();
    }
    if (degrees_of_freedom == 1) {
        return 1 / std::tan(both_tails * std::acos(-1.0) / 2);
    }
    if (degrees_of_freedom == 2) {
        return std::sqrt(2 / (both_tails * (2 - both_tails)) - 2);
    }
    const double z = normal_quantile(both_tails / 2), z2 = z * z;
    const double g1 = (z2 + 1) * z / 4;
    const double g2 = ((5 * z2 + 16) * z2 + 3) * z / 96;
    const double g3 = (((3 * z2 + 19) * z2 + 17) * z2 - 15) * z / 384;
    const double g4 = ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) * z / 92160;
    return z + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n;
}

RegressionEstimator::RegressionEstimator(const std::vector<TileWork>& population) {
    TileWork all = kNoWork;
    for (const TileWork& block : population) {
        all += block;
    }
    scale_.fill(1);
    const Terms sums = terms_of(all);
    for (std::size_t t = 0; t < kTerms; ++t) {
        scale_[t] = sums[t] > 0 ? static_cast<double>(population.size()) / sums[t] : 1;
    }
    population_.reserve(population.size());
    for (const TileWork& block : population) {
        population_.push_back(terms_of(block));
        for (std::size_t t = 0; t < kTerms; ++t) {
            sum_[t] += population_.back()[t];
        }
    }
}

// In the order of what they explain; a small sample is fitted to the first of them. The mean of
// each over the population is 1.
RegressionEstimator::Terms RegressionEstimator::terms_of(const TileWork& work) const {
    Terms terms{work.cycles, work.fragments, work.tiles,  work.rows,
                work.walked, work.tasks,     work.entries};
    for (std::size_t t = 0; t < kTerms; ++t) {
        terms[t] *= scale_[t];
    }
    return terms;
}

void RegressionEstimator::add(std::size_t block, std::size_t group, std::vector<double> measured) {
    const Terms& terms = population_[block];
    // The residuals scatter the more, the more work a run has: weights are inverse to the work.
    sample_.push_back({terms, 1 / (0.1 + terms[1] + terms[3]), group, std::move(measured)});
}

RegressionEstimator::Fit RegressionEstimator::fit(std::size_t measure, std::size_t left_out) const {
    Fit fit;
    for (const Block& block : sample_) {
        fit.blocks += block.group != left_out ? 1 : 0;
    }
    fit.terms = std::clamp<std::size_t>(fit.blocks / kBlocksPerTerm, 1, kTerms);
    Matrix<kTerms> matrix{};
    Terms right{};
    for (const Block& block : sample_) {
        if (block.group == left_out) {
            continue;
        }
        for (std::size_t i = 0; i < fit.terms; ++i) {
            for (std::size_t j = 0; j < fit.terms; ++j) {
                matrix[i][j] += block.weight * block.terms[i] * block.terms[j];
            }
            right[i] += block.weight * block.terms[i] * block.measured[measure];
        }
    }
    for (std::size_t i = 0; i < fit.terms; ++i) {
        constexpr double kRidge = 1e-6; // sizes that say the same share their slope
        matrix[i][i] = matrix[i][i] * (1 + kRidge) + std::numeric_limits<double>::min();
    }
    fit.slope = solve(matrix, right, fit.terms);
    for (const Block& block : sample_) {
        if (block.group == left_out) {
            continue;
        }
        double residual = block.measured[measure];
        for (std::size_t i = 0; i < fit.terms; ++i) {
            residual -= fit.slope[i] * block.terms[i];
        }
        fit.residuals += residual;
        if (left_out == kNobody) {
            // A block pulls the fit towards itself: without it, it would lie this far off.
            const Terms pull = solve(matrix, block.terms, fit.terms);
            double leverage = 0;
            for (std::size_t i = 0; i < fit.terms; ++i) {
                leverage += block.weight * pull[i] * block.terms[i];
            }
            residual /= 1 - std::min(leverage, 0.9);
        }
        fit.squares += residual * residual;
    }
    return fit;
}

double RegressionEstimator::total_of(const Fit& fit) const {
    double total = 0;
    for (std::size_t i = 0; i < fit.terms; ++i) {
        total += fit.slope[i] * sum_[i];
    }
    const auto population = static_cast<double>(population_.size());
    return fit.blocks == 0 ? total
                           : total + population * fit.residuals / static_cast<double>(fit.blocks);
}

Estimate RegressionEstimator::total(std::size_t measure, double confidence) const {
    const Fit all = fit(measure, kNobody);
    const auto population = static_cast<double>(population_.size());
    const auto n = static_cast<double>(all.blocks);
    Estimate estimate{total_of(all), std::numeric_limits<double>::infinity()};
    if (all.blocks == population_.size()) {
        estimate.half_width = 0;
    } else if (all.blocks > all.terms) {
        estimate.half_width = student_t(all.blocks - all.terms, confidence) * population *
                              std::sqrt(all.squares / n * (1 - n / population) / n);
    }
    return estimate;
}

double RegressionEstimator::total_without(std::size_t measure, std::size_t group) const {
    return total_of(fit(measure, group));
}

} // namespace degs::sim
