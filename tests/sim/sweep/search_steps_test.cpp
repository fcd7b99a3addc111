// SPDX-License-Identifier: Apache-2.0
// These tests lead a search step by step through made-up designs, and look at which designs it
// breeds, which it chooses, and what it reports.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sim/search/breeding.hpp"
#include "sim/search/evolution.hpp"
#include "sim/search/round_choice.hpp"
#include "sim/search/search.hpp"
#include "sim/search/search_record.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// So many designs, of which the first is the baseline.
StudyPlan plan_of(std::size_t designs, const std::string& goals) {
    StudyPlan plan;
    plan.name = "made up";
    plan.aims.goals = parse_goals(goals, "a test");
    for (std::size_t d = 0; d < designs; ++d) {
        plan.variants.push_back({"design " + std::to_string(d), "design", {}});
        plan.points.push_back({d, 0, 0, 0, std::string(32, static_cast<char>('a' + d))});
    }
    return plan;
}

/// Designs 0, 1, 2, ... with these values of the only goal.
StepResults results_of(const std::vector<double>& goals) {
    StepResults results;
    for (const double goal : goals) {
        Candidate candidate{results.candidates.size(), {}};
        candidate.verdict.goals = {goal};
        candidate.verdict.judged = true;
        results.candidates.push_back(std::move(candidate));
    }
    return results;
}

// Three designs of a front, of which only that in the middle has a crowd about it: it wins no
// tournament but one against itself, 1 of 9.
TEST(Breeding, PrefersWhoHasRoom) {
    constexpr std::size_t kGenes = 64, kChildren = 200;
    Breeding breeding(std::vector<Gene>(kGenes, Gene{1000, false}), 3, 7);
    breeding.take(
        {{Genes(kGenes, 10), {1, 4}}, {Genes(kGenes, 20), {2, 2}}, {Genes(kGenes, 30), {4, 1}}});
    std::size_t crowded = 0;
    for (std::size_t child = 0; child < kChildren; ++child) {
        const Genes place = breeding.propose();
        crowded += static_cast<std::size_t>(std::count(place.begin(), place.end(), 20));
    }
    EXPECT_GT(crowded, kGenes * kChildren / 20);
    EXPECT_LT(crowded, kGenes * kChildren / 4);
}

// If two are expected to be as good, the one of which less is known may be better.
TEST(RoundChoice, TakesTheDoubtfulAmongEquals) {
    const StudyPlan plan = plan_of(2, "latency_ms,area_mm2");
    RoundFacts facts;
    facts.aims = &plan.aims;
    facts.front = {{0.0, 0.0}};
    facts.prospects = {{5, {{-0.1, -0.1}, {0, 0}}}, {6, {{-0.1, -0.1}, {0.3, 0.3}}}};
    EXPECT_THAT(choose_round(facts, 1), ElementsAre(6));
}

// The median of two is between them.
TEST(SearchRecord, CountsDesignsAndErrors) {
    const StudyPlan plan = plan_of(3, "latency_ms");
    Search search;
    search.estimates = results_of({1, 2, 4});
    search.results = results_of({1, 2});
    search.results.cycles = 5;
    search.beliefs = {{0, 1, {1.02}}, {1, 1, {1.92}}, {2, 1, {4.0}}}; // the last was not simulated
    nlohmann::ordered_json json;
    put_record(plan, search, json);
    EXPECT_EQ(json["search"]["simulated"], 2);
    EXPECT_EQ(json["search"]["estimated"], 3);
    EXPECT_EQ(json["search"]["simulated_cycles"], 5);
    EXPECT_TRUE(json["beliefs"][2]["found"]["latency_ms"].is_null());
    EXPECT_THAT(record_text(plan, search),
                HasSubstr("5 cycles simulated; beliefs of latency_ms were off by 3.00 % (median)"));
}

TEST(SearchCycles, AreThoseOfSimulationsAlone) {
    const sim_test::Folder folder;
    std::ofstream(folder / "s.yaml") << "designs:\n  - include: " << sim_test::config("degs-64")
                                     << "\n    name: a\naxes:\n  span.count: [4, 8, 16]\n"
                                        "scenes: synthetic:object,gaussians=10\n"
                                        "width: 16\nreference: false\ngoals: latency_ms\n";
    const Study study = read_study(folder / "s.yaml");
    StudyPlan plan = plan_views(study);
    DesignSpace space(study, plan);
    space.add_baseline();
    EvolutionOptions options;
    options.budget = 2;
    Evolution evolution(space, plan, options);
    SearchPart alone;
    std::optional<Failure> failure;
    ASSERT_TRUE(search(plan, evolution, alone, folder / "out", failure));
    const Search found = evolution.found();
    ASSERT_TRUE(found.estimates);
    EXPECT_EQ(found.estimates->candidates.size(), 3U);
    EXPECT_EQ(found.estimates->cycles, 0);
    const auto written = nlohmann::json::parse(sim_test::read_file(folder / "out/results.json"));
    double cycles = 0;
    for (const auto& run : written["runs"]) {
        EXPECT_GT(run["cycles"], 0);
        cycles += run["cycles"].get<double>();
    }
    EXPECT_EQ(written["runs"].size(), 2U);
    EXPECT_EQ(found.results.cycles, cycles);
}

// Once is enough: what another part has found to fail is not run again.
TEST(SearchPart, LeavesOutWhatHasFailed) {
    const sim_test::Folder folder;
    const StudyPlan plan = plan_of(5, "latency_ms");
    const PointStore store(folder / "out", plan);
    store.keep_failure(0, {kUserError, "It cannot be."});
    EXPECT_THAT(SearchPart({1, 2}, 1).own_points(plan, store, ""), ElementsAre(1));
    EXPECT_THAT(SearchPart({2, 2}, 1).own_points(plan, store, ""), ElementsAre(2, 3, 4));
    EXPECT_THAT(SearchPart().own_points(plan, store, ""), ElementsAre(0, 1, 2, 3, 4));
}

TEST(PointStore, KeepsWhoseMistakeItWas) {
    const sim_test::Folder folder;
    const PointStore store(folder / "out", plan_of(3, "latency_ms"));
    store.keep_failure(0, {kUserError, "2 is too many."});
    store.keep_failure(1, {kInternalError, "2 is broken."});
    EXPECT_EQ(store.failure(0)->code, kUserError);
    EXPECT_EQ(store.failure(1)->code, kInternalError);
    EXPECT_EQ(store.failure(1)->sentence, "2 is broken.");
    EXPECT_FALSE(store.failure(2));
}

} // namespace
} // namespace degs::sim
