// SPDX-License-Identifier: Apache-2.0
#include "sim/search/breeding.hpp"

#include <algorithm>
#include <utility>

namespace degs::sim {
namespace {

constexpr double kCrossover = 0.9; ///< chance that a child has two parents
constexpr double kNeighbour = 0.5; ///< chance that a mutation of a number takes the next one

} // namespace

Breeding::Breeding(std::vector<Gene> genes, std::size_t population, std::uint64_t seed)
    : genes_(std::move(genes)), population_(population), random_(seed) {}

/// The distributions of the standard library differ between its implementations.
double Breeding::uniform() {
    constexpr int kUnused = 11; // bits beyond those of a double
    return static_cast<double>(random_() >> kUnused) * 0x1p-53;
}

std::size_t Breeding::below(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count));
}

bool Breeding::beats(std::size_t a, std::size_t b) const {
    if (parents_[a].excess != parents_[b].excess) {
        return parents_[a].excess < parents_[b].excess;
    }
    if (standings_[a].front != standings_[b].front) {
        return standings_[a].front < standings_[b].front;
    }
    return standings_[a].room > standings_[b].room;
}

std::size_t Breeding::tournament() {
    const std::size_t a = below(parents_.size());
    const std::size_t b = below(parents_.size());
    return beats(b, a) ? b : a;
}

std::size_t Breeding::mutated(const Gene& gene, std::size_t position) {
    if (gene.positions < 2) {
        return position;
    }
    if (gene.ordered && uniform() < kNeighbour) {
        const bool up = position == 0 || (position + 1 < gene.positions && uniform() < 0.5);
        return up ? position + 1 : position - 1;
    }
    const std::size_t other = below(gene.positions - 1);
    return other < position ? other : other + 1;
}

Genes Breeding::propose() {
    Genes place(genes_.size());
    if (parents_.empty()) {
        for (std::size_t g = 0; g < genes_.size(); ++g) {
            place[g] = below(genes_[g].positions);
        }
        return place;
    }
    const Genes& mother = parents_[tournament()].place;
    const Genes& father = uniform() < kCrossover ? parents_[tournament()].place : mother;
    const double chance = 1 / static_cast<double>(genes_.size());
    for (std::size_t g = 0; g < genes_.size(); ++g) {
        place[g] = uniform() < 0.5 ? mother[g] : father[g];
        place[g] = uniform() < chance ? mutated(genes_[g], place[g]) : place[g];
    }
    return place;
}

void Breeding::take(std::vector<Individual> children) {
    std::vector<Individual> all = std::move(parents_);
    std::move(children.begin(), children.end(), std::back_inserter(all));
    std::vector<Goals> costs;
    std::vector<double> excess;
    for (const Individual& each : all) {
        costs.push_back(each.costs);
        excess.push_back(each.excess);
    }
    parents_.clear();
    for (const std::size_t position : best_within(costs, excess, population_)) {
        parents_.push_back(std::move(all[position]));
    }
    rank();
}

/// Fronts are those of the designs within the limits; the others are compared by their excess.
void Breeding::rank() {
    std::vector<Goals> costs;
    std::vector<std::size_t> within;
    for (std::size_t p = 0; p < parents_.size(); ++p) {
        if (parents_[p].excess == 0) {
            within.push_back(p);
            costs.push_back(parents_[p].costs);
        }
    }
    standings_.assign(parents_.size(), {});
    const std::vector<Standing> found = standings_of(costs);
    for (std::size_t w = 0; w < within.size(); ++w) {
        standings_[within[w]] = found[w];
    }
}

} // namespace degs::sim
