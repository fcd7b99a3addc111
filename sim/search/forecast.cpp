// SPDX-License-Identifier: Apache-2.0
#include "sim/search/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace degs::sim {
namespace {

constexpr double kUnknown = 0.2;    ///< deviation where fewer than two designs have told
constexpr double kRoughness = 1e-3; ///< share of the variance that no similarity explains

/// Replaces a symmetric matrix of n rows by its Cholesky root.
void take_root(std::vector<double>& matrix, std::size_t n) {
    for (std::size_t row = 0; row < n; ++row) {
        for (std::size_t column = 0; column <= row; ++column) {
            double rest = matrix[row * n + column];
            for (std::size_t k = 0; k < column; ++k) {
                rest -= matrix[row * n + k] * matrix[column * n + k];
            }
            matrix[row * n + column] =
                row == column ? std::sqrt(rest) : rest / matrix[column * n + column];
        }
    }
}

/// The solution x of root · x = values.
std::vector<double> solved(const std::vector<double>& root, std::vector<double> values) {
    const std::size_t n = values.size();
    for (std::size_t row = 0; row < n; ++row) {
        for (std::size_t k = 0; k < row; ++k) {
            values[row] -= root[row * n + k] * values[k];
        }
        values[row] /= root[row * n + row];
    }
    return values;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

std::optional<double> logarithm(const std::optional<double>& value) {
    return value && *value > 0 && std::isfinite(*value) ? std::optional(std::log(*value))
                                                        : std::nullopt;
}

} // namespace

Columns columns_of(const DesignVerdict& verdict) {
    Columns columns;
    for (const std::optional<double>& goal : verdict.goals) {
        columns.push_back(logarithm(goal));
    }
    for (const LimitValue& limit : verdict.limits) {
        columns.push_back(logarithm(limit.value));
    }
    return columns;
}

double likeness(const std::vector<Gene>& genes, const Genes& a, const Genes& b) {
    double distance = 0; // from 0 to the number of genes
    for (std::size_t g = 0; g < genes.size(); ++g) {
        const bool own = a[g] == DesignSpace::kOwn || b[g] == DesignSpace::kOwn;
        if (a[g] != b[g]) {
            const double apart = static_cast<double>(std::max(a[g], b[g]) - std::min(a[g], b[g]));
            const double most = static_cast<double>(genes[g].positions - 1);
            distance += genes[g].ordered && !own ? apart / most : 1;
        }
    }
    const double alike = 1 - distance / static_cast<double>(genes.size());
    return (alike + std::exp(-distance)) / 2;
}

std::vector<std::size_t> most_unlike(const std::vector<Gene>& genes,
                                     const std::vector<Genes>& taken,
                                     const std::vector<Genes>& places, std::size_t count) {
    std::vector<double> nearest(places.size(), 0);
    const auto take = [&](const Genes& place) {
        for (std::size_t p = 0; p < places.size(); ++p) {
            nearest[p] = std::max(nearest[p], likeness(genes, places[p], place));
        }
    };
    std::for_each(taken.begin(), taken.end(), take);
    std::vector<std::size_t> chosen;
    while (chosen.size() < std::min(count, places.size())) {
        const auto least = std::min_element(nearest.begin(), nearest.end());
        chosen.push_back(static_cast<std::size_t>(least - nearest.begin()));
        take(places[chosen.back()]);
    }
    return chosen;
}

Forecast::Forecast(std::vector<Gene> genes, std::size_t columns)
    : genes_(std::move(genes)), processes_(columns) {}

void Forecast::learn(const Genes& place, const Columns& estimated, const Columns& found) {
    lessons_.push_back({place, estimated, found});
}

Forecast::Process Forecast::process_of(std::size_t column) const {
    Process process;
    std::vector<double> ratios;
    for (std::size_t l = 0; l < lessons_.size(); ++l) {
        if (const std::optional<double>& found = lessons_[l].found[column]) {
            process.lessons.push_back(l);
            ratios.push_back(*found - lessons_[l].estimated[column].value_or(0));
        }
    }
    const std::size_t n = ratios.size();
    process.root.resize(n * n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            process.root[i * n + j] = likeness(genes_, lessons_[process.lessons[i]].place,
                                               lessons_[process.lessons[j]].place) +
                                      (i == j ? kRoughness : 0);
        }
    }
    take_root(process.root, n);
    const std::vector<double> ones = solved(process.root, std::vector<double>(n, 1));
    process.mean = n == 0 ? 0 : product(ones, solved(process.root, ratios)) / product(ones, ones);
    for (double& ratio : ratios) {
        ratio -= process.mean;
    }
    process.weights = solved(process.root, ratios);
    process.variance = n < 2 ? kUnknown * kUnknown
                             : product(process.weights, process.weights) / static_cast<double>(n);
    return process;
}

void Forecast::conclude() {
    for (std::size_t c = 0; c < processes_.size(); ++c) {
        processes_[c] = process_of(c);
    }
}

Expectation Forecast::at(const Genes& place, const Columns& estimated) const {
    Expectation expected{estimated, {}};
    for (std::size_t c = 0; c < processes_.size(); ++c) {
        const Process& process = processes_[c];
        std::vector<double> shared;
        for (const std::size_t l : process.lessons) {
            shared.push_back(likeness(genes_, place, lessons_[l].place));
        }
        const std::vector<double> part = solved(process.root, shared);
        if (!part.empty()) {
            expected.columns[c] =
                estimated[c].value_or(0) + process.mean + product(part, process.weights);
        }
        const double unexplained = std::max(0.0, 1 + kRoughness - product(part, part));
        expected.deviations.push_back(std::sqrt(process.variance * unexplained));
    }
    return expected;
}

} // namespace degs::sim
