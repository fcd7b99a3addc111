// SPDX-License-Identifier: Apache-2.0
// A search that estimates many designs and simulates few: NSGA-II over estimates of the analytic
// model, then rounds of simulations, each of the designs that would add most to the front as the
// estimates, corrected by the simulations before, have it, and at last the neighbours of the front.
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
#include "sim/search/search_step.hpp"
#include "sim/sweep/design_space.hpp"

namespace degs::sim {

struct EvolutionOptions {
    std::size_t budget = 32; ///< designs that are simulated at most, with the baseline
    std::size_t population = 64;
    std::size_t generations = 32; ///< a space of no more than population x generations designs
                                  ///< is estimated whole
    std::uint64_t seed = 1;
};

class Evolution : public SearchSteps {
public:
    /// The space adds to the plan, which has the designs that are compared with, and no other;
    /// both outlive this object. Throws InputError if the budget does not suffice for these.
    Evolution(DesignSpace& space, const StudyPlan& plan, const EvolutionOptions& options);

    std::optional<Step> next() override;
    void take(const StepResults& results) override;
    /// Valid after the end.
    Search found() const;

private:
    /// A design that may be simulated.
    struct Known {
        Genes place;
        DesignVerdict estimate;             ///< may lack values
        std::optional<DesignVerdict> found; ///< by simulation
    };
    enum class Phase { Start, Breeding, AllEstimates, Rounds, Over };

    void start();
    std::optional<Step> next_generation();
    std::optional<Step> next_round();
    std::vector<std::size_t> choose(const RoundFacts& facts);
    std::vector<std::size_t> choose_neighbours(std::size_t count);
    /// Designs one step away from one of the front that were not simulated, by variant: the next
    /// number either way, or another word, on one axis.
    std::set<std::size_t> neighbours();
    std::vector<std::size_t> unlike(const RoundFacts& facts, std::size_t count) const;
    RoundFacts round_facts() const;
    /// Records the expected values of a design that is going to be simulated.
    void believe(std::size_t variant, const Columns& forecast);
    Step step_of(std::vector<std::size_t> variants, PartRuns runs) const;
    void take_estimates(const StepResults& results);
    void take_simulations(const StepResults& results);
    /// Adds a place to the next generation; false if it is known or cannot be built.
    bool add(const Genes& place);
    /// Adds so many proposals, or fewer if hardly any is new.
    void add_proposals(std::size_t count);
    Individual individual(const Known& known) const;
    std::string why_over(const RoundFacts& facts);

    DesignSpace& space_;
    const StudyPlan& plan_;
    EvolutionOptions options_;
    std::vector<std::size_t> kept_; ///< designs that others are compared with
    std::string no_estimates_;      ///< why there are none; empty: there are
    bool whole_;                    ///< every place of the space is looked at
    bool all_ = false;              ///< and simulated, because the budget has room for that
    Breeding breeding_;
    Phase phase_ = Phase::Start;
    std::size_t generation_ = 0;
    int round_ = 0;
    std::set<Genes> seen_;
    std::map<std::size_t, Genes> asked_; ///< in this generation, by variant
    std::map<std::size_t, Known> known_; ///< by variant
    std::set<std::size_t> tried_;        ///< variants that were simulated
    std::set<std::size_t> failed_;       ///< of them, those whose simulation failed: once is enough
    std::vector<FailedRun> failures_;    ///< in all rounds
    std::vector<Belief> beliefs_;
    std::optional<StepResults> estimates_; ///< of all designs
    StepResults results_;                  ///< of all rounds, or all estimates if these are wanted
    std::string end_;
};

} // namespace degs::sim
