// SPDX-License-Identifier: Apache-2.0
// A search that estimates many designs and simulates few: NSGA-II over estimates of the analytic
// model, then rounds of simulations, each of the designs that would add most to the front as the
// estimates, corrected by the simulations before, have it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim/search/breeding.hpp"
#include "sim/search/forecast.hpp"
#include "sim/search/round_choice.hpp"
#include "sim/search/searcher.hpp"
#include "sim/sweep/design_space.hpp"

namespace degs::sim {

struct EvolutionOptions {
    std::size_t budget = 32; ///< designs that are simulated at most, with the baseline
    std::size_t population = 64;
    std::size_t generations = 32; ///< a space that has not more designs than all is estimated whole
    std::uint64_t seed = 1;
};

class Evolution final : public Searcher {
public:
    /// The space adds to the plan, which has the designs that are compared with, and no other;
    /// both outlive this object. Throws InputError if the budget does not suffice for these, and if
    /// no goal has an estimate.
    Evolution(DesignSpace& space, const StudyPlan& plan, const EvolutionOptions& options);

    std::optional<Step> next() override;
    void take(const Rung& rung) override;
    const std::vector<Rung>& rungs() const override { return rungs_; }
    std::vector<Belief> beliefs() const override { return beliefs_; }
    Facts facts() const override;

private:
    /// A design that was estimated.
    struct Known {
        Genes place;
        DesignVerdict estimate;
        std::optional<DesignVerdict> found; ///< by simulation
    };
    enum class Phase { Breeding, AllEstimates, Rounds, Over };

    std::optional<Step> next_generation();
    std::optional<Step> next_round();
    RoundFacts round_facts() const;
    /// Records the expected values of a design that is going to be simulated.
    void believe(std::size_t variant, const Columns& forecast);
    Step step_of(std::vector<std::size_t> variants, bool estimates) const;
    void take_estimates(const Rung& rung);
    void take_simulations(const Rung& rung);
    /// Adds a place to the next generation, unless it is known or cannot be built.
    bool add(const Genes& place, std::vector<std::size_t>& variants);
    Individual individual(const Known& known) const;

    DesignSpace& space_;
    const StudyPlan& plan_;
    EvolutionOptions options_;
    std::vector<std::size_t> kept_; ///< designs that others are compared with
    bool whole_;                    ///< the space is estimated whole
    Breeding breeding_;
    Phase phase_ = Phase::Breeding;
    std::size_t generation_ = 0;
    int round_ = 0;
    std::set<Genes> seen_;
    std::map<std::size_t, Genes> asked_; ///< in this generation, by variant
    std::map<std::size_t, Known> known_; ///< by variant
    std::set<std::size_t> tried_;        ///< variants that were simulated
    std::set<std::size_t> failed_;       ///< of them, those whose simulation failed: once is enough
    std::vector<FailedRun> failures_;    ///< in all rounds
    std::vector<Belief> beliefs_;
    std::vector<Rung> rungs_;
    std::string end_;
};

} // namespace degs::sim
