// SPDX-License-Identifier: Apache-2.0
// NSGA-II over the places of a space of designs: tournaments among the better half, uniform
// crossover, mutation of single genes, and limits by constrained domination (K. Deb et al., A fast
// and elitist multiobjective genetic algorithm: NSGA-II, IEEE Trans. Evol. Comput. 2002). The
// NSGA-II of pagmo has neither limits nor categorical genes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "sim/search/selection.hpp"
#include "sim/sweep/design_space.hpp"

namespace degs::sim {

/// A place whose costs are known.
struct Individual {
    Genes place;
    Goals costs;
    double excess = 0; ///< over the limits; 0: it is within them
};

/// Breeds places that depend on the seed and on the answers alone.
class Breeding {
public:
    Breeding(std::vector<Gene> genes, std::size_t population, std::uint64_t seed);

    /// A place for the next generation: any place before the first one has been taken, and
    /// afterwards the child of two parents.
    Genes propose();
    /// The next generation, of which and of its parents the best live on.
    void take(std::vector<Individual> children);

private:
    double uniform(); ///< [0, 1)
    std::size_t below(std::size_t count);
    std::size_t tournament();
    std::size_t mutated(const Gene& gene, std::size_t position);
    /// Whether one of the parents is better than another.
    bool beats(std::size_t a, std::size_t b) const;
    void rank();

    std::vector<Gene> genes_;
    std::size_t population_;
    std::mt19937_64 random_;
    std::vector<Individual> parents_;
    std::vector<Standing> standings_; ///< of the parents; of use within the limits only
};

} // namespace degs::sim
