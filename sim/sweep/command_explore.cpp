// SPDX-License-Identifier: Apache-2.0
// degs explore: the designs of a study that nobody beats.
#include <memory>

#include "base/visible_text.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/simulation/warnings.hpp"
#include "sim/study/study_options.hpp"
#include "sim/sweep/search_output.hpp"
#include "sim/text/standard_output.hpp"

namespace degs::sim {
namespace {

struct ExploreOptions {
    StudyOptions study;
    SearchOptions search;
    std::string goals, limits; // empty: those of the study
    int jobs = 1;
    std::string out = "out";
};

void run(ExploreOptions& options) {
    Study study = study_of(options.study);
    if (!options.goals.empty() || study.goals.text.empty()) {
        study.goals = {options.goals.empty() ? kUsualGoals : options.goals, "--goals"};
    }
    if (!options.limits.empty()) {
        study.limits = {options.limits, "--limits"};
    }
    StudyPlan plan = plan_study(study);
    plan.request.jobs = options.jobs;
    std::optional<Failure> failure;
    const Search found = search(plan, options.search, options.out, failure);
    if (found.complete) {
        const OutputFolder folder(options.out, {"explore.json", "front.csv", "front.svg"});
        write_search(plan, found, folder);
        print(search_text(plan, found) +
              "\nall numbers, plots and the page: " + visible(folder.path("")) + "\n");
        print_warnings(found.rungs.back().warnings);
    }
    if (failure) {
        throw FailureError(*failure);
    }
}

} // namespace

void add_explore_command(CLI::App& program) {
    auto options = std::make_shared<ExploreOptions>();
    CLI::App* command = program.add_subcommand(
        "explore",
        "search a study for the designs that none beats in its goals, by default area and "
        "latency");
    add_study_options(*command, options->study);
    command
        ->add_option("--goals", options->goals,
                     "one to six, in place of those of the study: measures, as in the columns of "
                     "results.csv, or expressions of them; each is made small or large, whichever "
                     "is better, or as min: or max: in front says")
        ->type_name("GOAL,...")
        ->default_str(kUsualGoals);
    command
        ->add_option("--limits", options->limits,
                     "what designs must hold, in place of the limits of the study: "
                     "'area_mm2<=2.5, latency_ms<=1.02*baseline'")
        ->type_name("LIMIT,...");
    command
        ->add_option("--rungs", options->search.rungs,
                     "sizes of images: the first rung has 1/2^(N-1) of their sides, the last the "
                     "study's own")
        ->check(CLI::Range(1, 6))
        ->capture_default_str();
    command
        ->add_option("--share", options->search.share,
                     "one of so many designs goes on to the next rung")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    command->add_option("--least", options->search.least, "designs that go on at least")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    command->add_option("--jobs", options->jobs, "simulations at a time, each in its own process")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    add_out_option(*command, options->out, "folder for the front, the rungs and their reports");
    command->callback([options] { run(*options); });
}

} // namespace degs::sim
