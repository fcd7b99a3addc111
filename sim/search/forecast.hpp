// SPDX-License-Identifier: Apache-2.0
// What simulations of designs will find, by their estimates and by how far the estimates of similar
// designs were off.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sim/goals/judgement.hpp"
#include "sim/sweep/design_space.hpp"

namespace degs::sim {

/// The goals of an aim, then the values of its limits, as logarithms, so that corrections are
/// ratios. Empty: unknown, or not above 0.
using Columns = std::vector<std::optional<double>>;

Columns columns_of(const DesignVerdict& verdict);

/// What is expected of a simulation, and by how much (a standard deviation) that may be wrong.
struct Expectation {
    Columns columns;
    std::vector<double> deviations; ///< by column
};

/// From 0 to 1, how much alike what is found at two places is expected to be: other words, groups
/// of keys and designs are far from each other; numbers are the farther, the more positions lie
/// between them. Places that agree in more genes are more alike, both because a value of a gene
/// acts everywhere alike and because whole designs are alike.
double likeness(const std::vector<Gene>& genes, const Genes& a, const Genes& b);

/// The positions of at most `count` of the places, each as unlike those before it and those that
/// are taken as can be.
std::vector<std::size_t> most_unlike(const std::vector<Gene>& genes,
                                     const std::vector<Genes>& taken,
                                     const std::vector<Genes>& places, std::size_t count);

/// Corrects estimates by the ratios of found to estimated values. Each ratio is taken for a
/// Gaussian process over the space (kriging), whose covariance is the likeness. What has no
/// estimate at all is taken as estimated 1.
class Forecast {
public:
    Forecast(std::vector<Gene> genes, std::size_t columns);

    /// What was estimated and found at a place.
    void learn(const Genes& place, const Columns& estimated, const Columns& found);
    /// Draws the conclusions, before at() is asked.
    void conclude();

    Expectation at(const Genes& place, const Columns& estimated) const;

private:
    struct Lesson {
        Genes place;
        Columns estimated, found;
    };
    /// What the lessons say of a column.
    struct Process {
        std::vector<std::size_t> lessons; ///< that have the column
        std::vector<double> root;         ///< Cholesky root of the covariances, row by row
        std::vector<double> weights;      ///< by lesson
        double mean = 0, variance = 0;
    };
    Process process_of(std::size_t column) const;

    std::vector<Gene> genes_;
    std::vector<Lesson> lessons_;
    std::vector<Process> processes_; ///< by column
};

} // namespace degs::sim
