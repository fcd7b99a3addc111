// SPDX-License-Identifier: Apache-2.0
#include "sim/search/evolution.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/grouped_number.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "sim/analytic/analytic_run.hpp"

namespace degs::sim {
namespace {

constexpr std::size_t kLeastOfRound = 2;  ///< designs
constexpr std::size_t kMostRounds = 8;    ///< of about the same size
constexpr std::size_t kShareUnlike = 2;   ///< of the budget, for a first round without estimates
constexpr std::size_t kTries = 50;        ///< proposals for each place of a generation
constexpr std::size_t kForNeighbours = 4; ///< one design in so many of the budget, at least
constexpr std::size_t kMostWords = 8;     ///< more on an axis are samples, which have no neighbours
constexpr const char* kEstimates = "estimates";

bool has_estimate(const Aim& aim) {
    const std::vector<Measure> measures = measures_in({{aim}, {}});
    return std::all_of(measures.begin(), measures.end(),
                       [](Measure measure) { return is_estimated(measure); });
}

/// Why a search cannot begin with estimates; empty if it can.
std::string lack_of_estimates(const DesignSpace& space, const StudyPlan& plan) {
    if (plan.request.array_only) {
        return "the arrays run alone, and estimates are of whole accelerators";
    }
    const std::vector<Aim>& goals = plan.aims.goals;
    if (std::none_of(goals.begin(), goals.end(), has_estimate)) {
        return "none of the goals has an estimate";
    }
    for (const NamedConfig& design : space.designs()) {
        if (design.config.accelerator().analytic() == nullptr) {
            return config_words::quote(design.name) + " has no analytic model";
        }
    }
    return "";
}

/// The next number either way, or another word, in one place of the genes.
std::vector<Genes> places_beside(const std::vector<Gene>& genes, const Genes& place) {
    std::vector<Genes> places;
    for (std::size_t g = 0; g < genes.size(); ++g) {
        if (place[g] == DesignSpace::kOwn ||
            (!genes[g].ordered && genes[g].positions > kMostWords)) {
            continue;
        }
        for (std::size_t p = 0; p < genes[g].positions; ++p) {
            const std::size_t apart = p > place[g] ? p - place[g] : place[g] - p;
            if (apart == 1 || (apart > 1 && !genes[g].ordered)) {
                places.push_back(place);
                places.back()[g] = p;
            }
        }
    }
    return places;
}

/// What is known of a design that nobody has estimated: what does not depend on a frame.
DesignVerdict without_frame(const RunConfig& design, const Aims& aims) {
    const cost::BillOfMaterials bill = design.accelerator().bill();
    Measures measures;
    measures[Measure::AreaMm2] = bill.area_mm2();
    measures[Measure::SramBytes] = static_cast<double>(bill.sram_bytes());
    DesignVerdict verdict;
    for (const Aim& goal : aims.goals) {
        verdict.goals.push_back(goal.expression.value(measures));
    }
    for (const Limit& limit : aims.limits) {
        verdict.limits.push_back({limit.aim.expression.value(measures), {}});
    }
    return verdict;
}

} // namespace

Evolution::Evolution(DesignSpace& space, const StudyPlan& plan, const EvolutionOptions& options)
    : space_(space), plan_(plan), options_(options), kept_(kept_variants(plan)),
      no_estimates_(lack_of_estimates(space, plan)),
      whole_(!space.is_product() || space.size() <= options.population * options.generations),
      breeding_(space.genes(), options.population, options.seed) {
    std::sort(kept_.begin(), kept_.end());
    kept_.erase(std::unique(kept_.begin(), kept_.end()), kept_.end());
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

Step Evolution::step_of(std::vector<std::size_t> variants, PartRuns runs) const {
    variants.insert(variants.end(), kept_.begin(), kept_.end());
    std::sort(variants.begin(), variants.end());
    variants.erase(std::unique(variants.begin(), variants.end()), variants.end());
    const bool beside = runs == PartRuns::Estimates && !plan_.request.analytic;
    return {std::move(variants), runs, beside ? kEstimates : "", true};
}

/// A space of which every design is simulated needs no estimates; where there are none, designs are
/// known by their places and by what does not depend on a frame.
void Evolution::start() {
    phase_ = Phase::Breeding;
    if (whole_) {
        for (const Genes& place : space_.places()) {
            add(place);
        }
        all_ = !plan_.request.analytic && plan_.variants.size() <= options_.budget;
    }
    if (!all_ && no_estimates_.empty()) {
        return;
    }
    if (!whole_) {
        add_proposals(options_.population * options_.generations);
    }
    for (const auto& [variant, place] : asked_) {
        const RunConfig& design = plan_.request.configs[variant].config;
        known_.emplace(variant, Known{place, without_frame(design, plan_.aims), {}});
    }
    phase_ = Phase::Rounds;
}

std::optional<Step> Evolution::next() {
    if (phase_ == Phase::Start) {
        start();
    }
    if (phase_ == Phase::Breeding) {
        if (std::optional<Step> step = next_generation()) {
            return step;
        }
        phase_ = Phase::AllEstimates;
        std::vector<std::size_t> all;
        for (const auto& [variant, known] : known_) {
            all.push_back(variant);
        }
        return step_of(std::move(all), PartRuns::Estimates);
    }
    return phase_ == Phase::Rounds ? next_round() : std::nullopt;
}

bool Evolution::add(const Genes& place) {
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
    return true;
}

void Evolution::add_proposals(std::size_t count) {
    std::size_t added = 0;
    for (std::size_t tries = count * kTries; tries > 0 && added < count; --tries) {
        added += add(breeding_.propose()) ? 1 : 0;
    }
}

std::optional<Step> Evolution::next_generation() {
    if (!whole_ && generation_ < options_.generations) {
        add_proposals(options_.population);
    }
    ++generation_;
    if (asked_.empty()) {
        return {};
    }
    std::vector<std::size_t> variants;
    for (const auto& [variant, place] : asked_) {
        variants.push_back(variant);
    }
    Step step = step_of(std::move(variants), PartRuns::Estimates);
    step.results = false; // all estimates get them together
    return step;
}

void Evolution::take(const StepResults& results) {
    if (phase_ == Phase::Breeding) {
        take_estimates(results);
    } else if (phase_ == Phase::Rounds) {
        take_simulations(results);
    } else if (plan_.request.analytic) {
        phase_ = Phase::Over;
        results_ = results;
    } else {
        phase_ = Phase::Rounds;
        estimates_ = results;
    }
}

/// In a generation, goals without estimates are the same for all, so that they decide nothing.
Individual Evolution::individual(const Known& known) const {
    Goals goals;
    for (const std::optional<double>& goal : known.estimate.goals) {
        goals.push_back(goal.value_or(1));
    }
    return {known.place, costs_of(goals, plan_.aims.goals), excess_of(known.estimate)};
}

void Evolution::take_estimates(const StepResults& results) {
    std::vector<Individual> children;
    for (const Candidate& candidate : results.candidates) {
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
    if (all_) { // nobody has chosen it
        return;
    }
    Belief belief{variant, round_, {}};
    for (std::size_t g = 0; g < plan_.aims.goals.size(); ++g) {
        belief.goals.push_back(forecast[g] ? std::optional(std::exp(*forecast[g])) : std::nullopt);
    }
    beliefs_.push_back(std::move(belief));
}

/// The first designs where nothing is believed of any.
std::vector<std::size_t> Evolution::unlike(const RoundFacts& facts, std::size_t count) const {
    std::vector<Genes> taken;
    for (const std::size_t variant : kept_) {
        taken.push_back(known_.at(variant).place);
    }
    std::vector<Genes> places;
    for (const Prospect& prospect : facts.prospects) {
        places.push_back(known_.at(prospect.variant).place);
    }
    std::vector<std::size_t> variants;
    for (const std::size_t place : most_unlike(space_.genes(), taken, places, count)) {
        variants.push_back(facts.prospects[place].variant);
    }
    return variants;
}

std::vector<std::size_t> Evolution::choose(const RoundFacts& facts) {
    if (round_ == 1 && !estimates_) {
        return unlike(facts, all_ ? facts.prospects.size() : options_.budget / kShareUnlike);
    }
    const std::size_t size =
        std::max(kLeastOfRound, (options_.budget + kMostRounds - 1) / kMostRounds);
    const std::size_t count = std::min(size, options_.budget - tried_.size());
    const std::size_t kept_back = space_.is_product() ? options_.budget / kForNeighbours : 0;
    std::vector<std::size_t> chosen;
    if (tried_.size() + kept_back < options_.budget) {
        chosen = choose_round(facts, std::min(count, options_.budget - kept_back - tried_.size()));
    }
    return chosen.empty() && round_ > 1 ? choose_neighbours(count) : chosen;
}

std::set<std::size_t> Evolution::neighbours() {
    std::vector<Genes> front;
    for (const auto& [variant, known] : known_) {
        if (space_.is_product() && known.found && known.found->on_front) {
            front.push_back(known.place);
        }
    }
    std::set<std::size_t> variants;
    for (const Genes& place : front) {
        for (Genes& beside : places_beside(space_.genes(), place)) {
            const std::optional<std::size_t> variant = space_.add(beside).variant;
            if (variant && tried_.count(*variant) == 0) {
                const RunConfig& design = plan_.request.configs[*variant].config;
                known_.emplace(*variant,
                               Known{std::move(beside), without_frame(design, plan_.aims), {}});
                variants.insert(*variant);
            }
        }
    }
    return variants;
}

/// The most likely ones first.
std::vector<std::size_t> Evolution::choose_neighbours(std::size_t count) {
    const std::set<std::size_t> beside = neighbours();
    RoundFacts facts = round_facts();
    const auto elsewhere = [&beside](const Prospect& prospect) {
        return beside.count(prospect.variant) == 0;
    };
    facts.prospects.erase(std::remove_if(facts.prospects.begin(), facts.prospects.end(), elsewhere),
                          facts.prospects.end());
    std::vector<std::size_t> chosen = choose_round(facts, count);
    for (const std::size_t variant : beside) {
        if (chosen.size() < count &&
            std::find(chosen.begin(), chosen.end(), variant) == chosen.end()) {
            chosen.push_back(variant);
        }
    }
    return chosen;
}

std::string Evolution::why_over(const RoundFacts& facts) {
    if (all_) {
        return "the budget has room for all designs";
    }
    if (tried_.size() == options_.budget) {
        const std::size_t left = neighbours().size();
        return left == 0 ? "the budget is used"
                         : "the budget is used, and " + grouped(left) +
                               (left == 1 ? " neighbour" : " neighbours") +
                               " of the front were not simulated";
    }
    const std::string kind = estimates_ ? "estimated " : whole_ ? "" : "drawn ";
    return facts.prospects.empty()
               ? "all " + kind + "designs were simulated"
               : "no neighbour of the front beats it, and no other " + kind + "design is likely to";
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
    const std::vector<std::size_t> chosen = choose(facts);
    if (chosen.empty() && round_ > 1) { // the first has at least what others are compared with
        phase_ = Phase::Over;
        end_ = why_over(facts);
        return {};
    }
    for (const Prospect& prospect : round_facts().prospects) { // neighbours may have joined them
        if (std::find(chosen.begin(), chosen.end(), prospect.variant) != chosen.end()) {
            believe(prospect.variant, prospect.expected.columns);
        }
    }
    tried_.insert(chosen.begin(), chosen.end());
    std::vector<std::size_t> variants; // a round has what ran before it, too
    std::set_difference(tried_.begin(), tried_.end(), failed_.begin(), failed_.end(),
                        std::back_inserter(variants));
    Step step = step_of(std::move(variants), PartRuns::AsPlanned);
    step.spent = estimates_ ? grouped(known_.size()) + " designs estimated, " : "";
    step.spent += grouped(tried_.size()) + (estimates_ ? " simulated" : " designs simulated");
    return step;
}

void Evolution::take_simulations(const StepResults& results) {
    for (const Candidate& candidate : results.candidates) {
        if (const auto known = known_.find(candidate.variant); known != known_.end()) {
            known->second.found = candidate.verdict;
        }
    }
    for (const std::size_t variant : tried_) {
        const bool ran = std::any_of(
            results.candidates.begin(), results.candidates.end(),
            [variant](const Candidate& candidate) { return candidate.variant == variant; });
        if (!ran) {
            failed_.insert(variant);
        }
    }
    failures_.insert(failures_.end(), results.failed.begin(), results.failed.end());
    if (std::any_of(kept_.begin(), kept_.end(),
                    [this](std::size_t variant) { return failed_.count(variant) != 0; })) {
        phase_ = Phase::Over;
        end_ = "a design that others are compared with failed";
    }
    results_ = results;
    results_.failed = failures_;
}

Search Evolution::found() const {
    return {estimates_,
            results_,
            beliefs_,
            {{"seed", options_.seed},
             {"budget", options_.budget},
             {"population", options_.population},
             {"generations", options_.generations},
             {"space", space_.size()}},
            all_ ? "" : no_estimates_,
            end_};
}

} // namespace degs::sim
