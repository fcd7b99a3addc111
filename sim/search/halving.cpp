// SPDX-License-Identifier: Apache-2.0
#include "sim/search/halving.hpp"

#include <algorithm>
#include <numeric>

namespace degs::sim {
namespace {

/// The variants that go on, and those with which results are compared.
std::vector<std::size_t> survivors(const Rung& rung, const StudyPlan& plan,
                                   const HalvingOptions& options) {
    std::vector<Goals> costs;
    std::vector<double> excess;
    for (const Candidate& candidate : rung.candidates) {
        costs.push_back(costs_of(goals_of(candidate.verdict), plan.aims.goals));
        excess.push_back(excess_of(candidate.verdict));
    }
    const std::size_t count = std::max(options.least, rung.candidates.size() / options.share);
    std::vector<std::size_t> variants = kept_variants(plan);
    for (const std::size_t position : best_within(costs, excess, count)) {
        variants.push_back(rung.candidates[position].variant);
    }
    std::sort(variants.begin(), variants.end());
    variants.erase(std::unique(variants.begin(), variants.end()), variants.end());
    return variants;
}

} // namespace

Halving::Halving(const StudyPlan& plan, const HalvingOptions& options)
    : plan_(plan), options_(options), variants_(plan.variants.size()) {
    std::iota(variants_.begin(), variants_.end(), 0);
}

std::optional<Step> Halving::next() {
    const int rung = static_cast<int>(rungs_.size());
    if (rung == options_.rungs) {
        return {};
    }
    const int divisor = 1 << (options_.rungs - 1 - rung);
    return Step{
        variants_, {divisor, false}, divisor == 1 ? "" : "rung-" + std::to_string(rung + 1)};
}

void Halving::take(const Rung& rung) {
    variants_ = survivors(rung, plan_, options_);
    rungs_.push_back(rung);
}

Searcher::Facts Halving::facts() const {
    return {"halving",
            {{"rungs", options_.rungs}, {"share", options_.share}, {"least", options_.least}},
            ""};
}

} // namespace degs::sim
