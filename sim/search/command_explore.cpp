// SPDX-License-Identifier: Apache-2.0
// degs explore: the designs of a study that nobody beats.
#include <memory>

#include "base/visible_text.hpp"
#include "degs/error.hpp"
#include "sim/search/evolution.hpp"
#include "sim/search/search.hpp"
#include "sim/search/search_output.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/study/study_options.hpp"
#include "sim/sweep/sweep_results.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/warnings.hpp"

namespace degs::sim {
namespace {

struct ExploreOptions {
    StudyOptions study;
    EvolutionOptions evolution;
    std::string goals, limits; // empty: those of the study
    int jobs = 1;
    std::optional<std::string> shard;
    double patience = 60; ///< minutes
    std::string out = "out";
};

Study searched_study(const ExploreOptions& options) {
    Study study = study_of(options.study);
    if (!options.goals.empty() || study.goals.text.empty()) {
        study.goals = {options.goals.empty() ? kUsualGoals : options.goals, "--goals"};
    }
    if (!options.limits.empty()) {
        study.limits = {options.limits, "--limits"};
    }
    return study;
}

void run_search(const ExploreOptions& options, const StudyPlan& plan, Evolution& evolution) {
    std::optional<Failure> failure;
    SearchPart part = options.shard ? SearchPart(parse_shard(*options.shard), 60 * options.patience)
                                    : SearchPart();
    const bool complete = search(plan, evolution, part, options.out, failure);
    if (complete && !part.writes()) {
        print(part.name() + " has ended; part 1 writes the results\n");
    } else if (complete) {
        const Search found = evolution.found();
        const OutputFolder folder(options.out, search_files());
        write_search(plan, found, folder);
        print(search_text(plan, found) +
              "\nall numbers, plots and the page: " + visible(folder.path("")) + "\n");
        print_warnings(found.results.warnings);
    }
    if (failure) {
        throw FailureError(*failure);
    }
}

/// Throws InputError if estimates are asked for of a design that has none.
void check_designs(const StudyPlan& plan, std::vector<NamedConfig> designs) {
    CompareRequest request = plan.request;
    request.configs = std::move(designs);
    check_estimates(request);
}

void explore(const ExploreOptions& options) {
    const Study study = searched_study(options);
    StudyPlan plan = plan_views(study);
    plan.request.jobs = options.jobs;
    DesignSpace space(study, plan);
    check_designs(plan, space.designs());
    space.add_baseline();
    for (const std::string& name : designs_in(plan.aims)) {
        space.add_design(name);
    }
    check_aims(plan);
    EvolutionOptions wanted = options.evolution;
    wanted.seed = options.study.seed;
    Evolution evolution(space, plan, wanted);
    run_search(options, plan, evolution);
}

void add_evolution_options(CLI::App& command, EvolutionOptions& options) {
    command
        .add_option(
            "--budget", options.budget,
            "designs that are simulated at most, with the baseline; a space without more is "
            "simulated whole")
        ->check(CLI::Range(2, 100000))
        ->capture_default_str();
    command.add_option("--population", options.population, "designs of a generation of estimates")
        ->check(CLI::Range(4, 10000))
        ->capture_default_str();
    command
        .add_option("--generations", options.generations,
                    "of estimates; a space without more designs than all have is estimated whole")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
}

void add_shard_options(CLI::App& command, ExploreOptions& options) {
    command
        .add_option("--shard", options.shard,
                    "search together with N-1 other processes in the same folder: this one "
                    "runs the K-th of N parts of every step, or with auto that of this task "
                    "of a job array; the first one writes the results")
        ->type_name("K/N");
    command
        .add_option("--patience", options.patience,
                    "minutes without a point of the others after which a part gives up")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
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
    add_evolution_options(*command, options->evolution);
    add_jobs_option(*command, options->jobs);
    add_out_option(*command, options->out, "folder for the front, the estimates and the reports");
    add_shard_options(*command, *options);
    command->get_option("--seed")->description(
        "of the draw of tiles with --within, and of the designs of a large space");
    command->callback([options] { explore(*options); });
}

} // namespace degs::sim
