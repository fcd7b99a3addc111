// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace degs {

/// Where the seven sigma points of a Gaussian lie, and what they weigh: the scaled unscented
/// transform in three dimensions. The defaults are those of 3DGUT (Wu et al., CVPR 2025).
struct SigmaPoints {
    double alpha = 1; ///< spread
    double beta = 2;  ///< what is known of the distribution; 2 suits Gaussians
    double kappa = 0;

    /// Standard deviations from the mean to each of the six outer points.
    double distance() const { return alpha * std::sqrt(3 + kappa); }
    /// The weight of each outer point, in the mean and in the covariance.
    double weight() const { return 0.5 / (alpha * alpha * (3 + kappa)); }
    /// The weight of the projected mean, in the covariance alone: means are formed of differences
    /// from that point, so that its weight there is whatever makes the sum 1.
    double centre_weight() const {
        return 1 - 3 / (alpha * alpha * (3 + kappa)) + 1 - alpha * alpha + beta;
    }
    /// Whether the points exist and no weight of the covariance is negative; otherwise determinants
    /// could be, too.
    bool is_sound() const {
        return std::isfinite(distance()) && distance() > 0 && centre_weight() >= 0;
    }

    bool operator==(const SigmaPoints& other) const {
        return alpha == other.alpha && beta == other.beta && kappa == other.kappa;
    }
    bool operator!=(const SigmaPoints& other) const { return !(*this == other); }
};

} // namespace degs
