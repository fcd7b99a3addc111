// SPDX-License-Identifier: Apache-2.0
#include "sim/search/evolution.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/grouped_number.hpp"
#include "degs/error.hpp"
#include "sim/analytic/analytic_run.hpp"

namespace degs::sim {
namespace {

constexpr std::size_t kLeastOfRound = 2; ///< designs
constexpr std::size_t kMostRounds = 8;   ///< of about the same size
constexpr std::size_t kTries = 50;       ///< proposals for each place of a generation
constexpr const char* kEstimates = "rung-1";

bool has_estimate(const Aim& aim) {
    const std::vector<Measure> measures = measures_in({{aim}, {}});
    return std::all_of(measures.begin(), measures.end(),
                       [](Measure measure) { return is_estimated(measure); });
}

/// The next place; false after the last one.
bool advance(Genes& place, const std::vector<Gene>& genes) {
    for (std::size_t g = place.size(); g-- > 0;) {
        if (++place[g] < genes[g].positions) {
            return true;
        }
        place[g] = 0;
    }
    return false;
}

} // namespace

Evolution::Evolution(DesignSpace& space, const StudyPlan& plan, const EvolutionOptions& options)
    : space_(space), plan_(plan), options_(options), kept_(kept_variants(plan)),
      whole_(space.size() <= options.population * options.generations),
      breeding_(space.genes(), options.population, options.seed) {
    std::sort(kept_.begin(), kept_.end());
    kept_.erase(std::unique(kept_.begin(), kept_.end()), kept_.end());
    const std::vector<Aim>& goals = plan.aims.goals;
    if (std::none_of(goals.begin(), goals.end(),
                     [](const Aim& goal) { return has_estimate(goal); })) {
        throw InputError("None of the goals has an estimate, so --search evolution cannot look for "
                         "them; --search halving can.");
    }
    if (options.budget <= kept_.size()) {
        throw InputError("--budget " + std::to_string(options.budget) +
                         " leaves nothing to search, because the designs that others are compared "
                         "with are simulated, too; at least " +
                         std::to_string(kept_.size() + 1) + " are needed.");
    }
    for (const std::size_t variant : kept_) {
        asked_[variant] = Genes(space.genes().size(), DesignSpace::kOwn);
    }
}

Step Evolution::step_of(std::vector<std::size_t> variants, bool estimates) const {
    variants.insert(variants.end(), kept_.begin(), kept_.end());
    std::sort(variants.begin(), variants.end());
    variants.erase(std::unique(variants.begin(), variants.end()), variants.end());
    return {std::move(variants), {1, estimates}, estimates ? kEstimates : "", true};
}

std::optional<Step> Evolution::next() {
    if (phase_ == Phase::Breeding) {
        if (std::optional<Step> step = next_generation()) {
            return step;
        }
        phase_ = Phase::AllEstimates;
        std::vector<std::size_t> all;
        for (const auto& [variant, known] : known_) {
            all.push_back(variant);
        }
        Step step = step_of(std::move(all), true);
        step.folder = plan_.request.analytic ? "" : kEstimates;
        return step;
    }
    return phase_ == Phase::Rounds ? next_round() : std::nullopt;
}

bool Evolution::add(const Genes& place, std::vector<std::size_t>& variants) {
    if (!seen_.insert(place).second) {
        return false;
    }
    const std::optional<std::size_t> variant = space_.add(place).variant;
    if (!variant) {
        return false;
    }
    const auto known = known_.find(*variant);
    if (known != known_.end()) { // one that others are compared with, which has a place after all
        known->second.place = place;
        return false;
    }
    asked_[*variant] = place;
    variants.push_back(*variant);
    return true;
}

std::optional<Step> Evolution::next_generation() {
    std::vector<std::size_t> variants;
    if (whole_) {
        Genes place(space_.genes().size(), 0);
        do {
            add(place, variants);
        } while (generation_ == 0 && advance(place, space_.genes()));
    }
    for (std::size_t tries = options_.population * kTries;
         !whole_ && generation_ < options_.generations && tries > 0 &&
         variants.size() < options_.population;
         --tries) {
        add(breeding_.propose(), variants);
    }
    ++generation_;
    if (variants.empty()) {
        return {};
    }
    Step step = step_of(std::move(variants), true);
    step.results = false; // all estimates get them together
    return step;
}

void Evolution::take(const Rung& rung) {
    if (phase_ == Phase::Breeding) {
        take_estimates(rung);
        return;
    }
    if (phase_ == Phase::AllEstimates) {
        phase_ = plan_.request.analytic ? Phase::Over : Phase::Rounds;
        rungs_.push_back(rung);
        return;
    }
    take_simulations(rung);
}

/// In a generation, goals without estimates are the same for all, so that they decide nothing.
Individual Evolution::individual(const Known& known) const {
    Goals goals;
    for (const std::optional<double>& goal : known.estimate.goals) {
        goals.push_back(goal.value_or(1));
    }
    return {known.place, costs_of(goals, plan_.aims.goals), excess_of(known.estimate)};
}

void Evolution::take_estimates(const Rung& rung) {
    std::vector<Individual> children;
    for (const Candidate& candidate : rung.candidates) {
        const auto asked = asked_.find(candidate.variant);
        if (asked != asked_.end()) {
            const auto [known, is_new] =
                known_.emplace(candidate.variant, Known{asked->second, candidate.verdict, {}});
            const bool bred = std::find(asked->second.begin(), asked->second.end(),
                                        DesignSpace::kOwn) == asked->second.end();
            if (is_new && bred) {
                children.push_back(individual(known->second));
            }
        }
    }
    asked_.clear();
    breeding_.take(std::move(children));
}

RoundFacts Evolution::round_facts() const {
    RoundFacts facts;
    facts.aims = &plan_.aims;
    facts.bounds.resize(plan_.aims.limits.size());
    Forecast forecast(space_.genes(), plan_.aims.goals.size() + plan_.aims.limits.size());
    for (const auto& [variant, known] : known_) {
        const DesignVerdict& verdict = known.found ? *known.found : known.estimate;
        for (std::size_t l = 0; l < facts.bounds.size(); ++l) { // simulated ones are preferred
            std::optional<double>& bound = facts.bounds[l];
            bound = known.found || !bound ? verdict.limits[l].bound : bound;
        }
        if (known.found) {
            forecast.learn(known.place, columns_of(known.estimate), columns_of(verdict));
        }
        if (known.found && verdict.is_within()) {
            facts.front.push_back(columns_of(verdict));
        }
    }
    forecast.conclude();
    for (const auto& [variant, known] : known_) {
        if (tried_.count(variant) == 0) {
            facts.prospects.push_back(
                {variant, forecast.at(known.place, columns_of(known.estimate))});
        }
    }
    return facts;
}

void Evolution::believe(std::size_t variant, const Columns& forecast) {
    Belief belief{variant, round_, {}};
    for (std::size_t g = 0; g < plan_.aims.goals.size(); ++g) {
        belief.goals.push_back(forecast[g] ? std::optional(std::exp(*forecast[g])) : std::nullopt);
    }
    beliefs_.push_back(std::move(belief));
}

std::optional<Step> Evolution::next_round() {
    ++round_;
    for (std::size_t k = 0; round_ == 1 && k < kept_.size(); ++k) {
        tried_.insert(kept_[k]);
        if (const auto known = known_.find(kept_[k]); known != known_.end()) {
            believe(kept_[k], columns_of(known->second.estimate));
        }
    }
    const RoundFacts facts = round_facts();
    const std::size_t size =
        std::max(kLeastOfRound, (options_.budget + kMostRounds - 1) / kMostRounds);
    const std::vector<std::size_t> chosen =
        choose_round(facts, std::min(size, options_.budget - tried_.size()));
    if (chosen.empty()) {
        phase_ = Phase::Over;
        end_ = tried_.size() == options_.budget ? "the budget is used"
               : facts.prospects.empty()        ? "all estimated designs were simulated"
                                         : "no other estimated design is likely to enter the front";
        return {};
    }
    for (const Prospect& prospect : facts.prospects) {
        if (std::find(chosen.begin(), chosen.end(), prospect.variant) != chosen.end()) {
            believe(prospect.variant, prospect.expected.columns);
        }
    }
    tried_.insert(chosen.begin(), chosen.end());
    std::vector<std::size_t> variants; // a round has what ran before it, too
    std::set_difference(tried_.begin(), tried_.end(), failed_.begin(), failed_.end(),
                        std::back_inserter(variants));
    Step step = step_of(std::move(variants), false);
    step.spent =
        grouped(known_.size()) + " designs estimated, " + grouped(tried_.size()) + " simulated";
    return step;
}

void Evolution::take_simulations(const Rung& rung) {
    for (const Candidate& candidate : rung.candidates) {
        if (const auto known = known_.find(candidate.variant); known != known_.end()) {
            known->second.found = candidate.verdict;
        }
    }
    for (const std::size_t variant : tried_) {
        const bool ran = std::any_of(
            rung.candidates.begin(), rung.candidates.end(),
            [variant](const Candidate& candidate) { return candidate.variant == variant; });
        if (!ran) {
            failed_.insert(variant);
        }
    }
    failures_.insert(failures_.end(), rung.failed.begin(), rung.failed.end());
    if (std::any_of(kept_.begin(), kept_.end(),
                    [this](std::size_t variant) { return failed_.count(variant) != 0; })) {
        phase_ = Phase::Over;
        end_ = "a design that others are compared with failed";
    }
    rungs_.resize(1);
    rungs_.push_back(rung);
    rungs_.back().failed = failures_;
}

Searcher::Facts Evolution::facts() const {
    return {"evolution",
            {{"seed", options_.seed},
             {"budget", options_.budget},
             {"population", options_.population},
             {"generations", options_.generations},
             {"space", space_.size()}},
            end_};
}

} // namespace degs::sim
