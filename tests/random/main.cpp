// SPDX-License-Identifier: Apache-2.0
// degs_random_designs: draws designs over all keys of all accelerators and looks for one that
// hangs, crashes, breaks a law or shows a wrong image. docs/random-designs.md
#include <cstdlib>
#include <iostream>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <systemc>

#include "tests/random/draw.hpp"
#include "tests/random/minimise.hpp"
#include "tests/random/verdict.hpp"

namespace degs::trials {
namespace {

struct Options {
    std::uint64_t designs = 200, seed = 1, first = 0;
    int jobs = 1;
    int attempts = 200;
    int shown = 2; ///< failures of a kind that are made smaller and printed
    Limits limits;
    std::string configs = DEGS_CONFIGS;
    std::string cameras = DEGS_RANDOM_CAMERAS;
};

struct Finding {
    std::uint64_t index = 0;
    Trial trial;
    Verdict verdict;
};

Verdict verdict_of(const Trial& trial, const Options& options) {
    if (const std::string problem = refusal(options.configs, trial); !problem.empty()) {
        return {"refused", problem};
    }
    Verdict result;
    run_trials({trial}, options.configs, options.cameras, options.limits, options.jobs,
               [&](std::size_t, const Verdict& verdict) { result = verdict; });
    return result;
}

void print(const Finding& finding, const Options& options) {
    const std::string kind = finding.verdict.kind;
    const Trial small = minimised(
        finding.trial, [&](const Trial& trial) { return verdict_of(trial, options).kind == kind; },
        options.attempts);
    std::cout << "design " << finding.index << ", " << kind << ": "
              << verdict_of(small, options).sentence << "\n  degs " << small.arguments() << "\n"
              << std::flush;
}

/// Checks a design that somebody names, in the words in which findings are printed.
bool check(Trial trial, const Options& options) {
    trial.config = trial.config.substr(trial.config.rfind('/') + 1);
    const Verdict verdict = verdict_of(trial, options);
    std::cout << (verdict.kind.empty()
                      ? "nothing is wrong, " + std::to_string(verdict.cycles) + " cycles"
                      : verdict.kind + ": " + verdict.sentence)
              << '\n'
              << std::flush;
    return verdict.kind.empty();
}

/// The options of `degs run` that findings use.
void add_run_command(CLI::App& app, Trial& trial, Options& options) {
    CLI::App* run = app.add_subcommand("run", "checks one design; options as of `degs run`");
    run->add_option("config", trial.config, "name of a shipped design")->required();
    run->add_option("--scene", trial.scene, "as of `degs run`")->required();
    run->add_option("--cameras", options.cameras);
    run->add_option("--camera", trial.camera);
    run->add_option("--width", trial.width);
    run->add_option("--height", trial.height);
    run->add_option("--frames", trial.frames);
    run->add_option("--path-step", trial.step_degrees);
    run->add_option("--eyes", trial.eyes);
    run->add_option("--foveation", trial.foveation);
    run->add_flag("--array-only", trial.array_only);
    run->add_option_function<std::vector<std::string>>(
           "--set",
           [&trial](const std::vector<std::string>& settings) {
               for (const std::string& setting : settings) {
                   const std::size_t equals = setting.find('=');
                   trial.changes.push_back({setting.substr(0, equals), setting.substr(equals + 1)});
               }
           })
        ->allow_extra_args(false)
        ->trigger_on_parse(false);
}

/// Draws, runs, reports. True if nothing was found.
bool search(const Options& options) {
    DrawCounts counts;
    std::vector<Trial> trials;
    std::map<std::string, std::uint64_t> designs;
    for (std::uint64_t i = 0; i < options.designs; ++i) {
        trials.push_back(draw_trial(options.configs, options.seed, options.first + i, counts));
        ++designs[trials.back().config];
    }
    std::cout << counts.drawn << " designs of seed " << options.seed << " from number "
              << options.first << ": " << counts.changes << " changed keys; " << counts.refused
              << " designs were refused at first and repaired by taking back " << counts.dropped
              << " changes\n"
              << std::flush;
    std::vector<Finding> findings;
    std::map<std::string, int> kinds;
    std::uint64_t most_cycles = 0;
    const bool finished =
        run_trials(trials, options.configs, options.cameras, options.limits, options.jobs,
                   [&](std::size_t index, const Verdict& verdict) {
                       most_cycles = std::max(most_cycles, verdict.cycles);
                       if (!verdict.kind.empty()) {
                           if (++kinds[verdict.kind] <= options.shown) {
                               std::cout << "design " << options.first + index << ", "
                                         << verdict.kind << ": " << verdict.sentence << "\n"
                                         << std::flush;
                           }
                           findings.push_back({options.first + index, trials[index], verdict});
                       }
                   });
    std::cout << findings.size() << " failed";
    for (const auto& [kind, count] : kinds) {
        std::cout << "\n  " << count << " x " << kind;
    }
    std::cout << "\nlongest run " << most_cycles << " cycles\n" << std::flush;
    if (options.attempts > 0) {
        std::map<std::string, int> shown;
        for (const Finding& finding : findings) {
            if (shown[finding.verdict.kind]++ < options.shown) {
                print(finding, options);
            }
        }
    }
    return finished && findings.empty();
}

int run(int argc, char* argv[]) {
    Options options;
    CLI::App app{"draws designs and looks for one that fails"};
    app.add_option("--designs", options.designs, "how many")->capture_default_str();
    app.add_option("--seed", options.seed)->capture_default_str();
    app.add_option("--first", options.first, "number of the first design")->capture_default_str();
    app.add_option("--jobs", options.jobs, "processes at a time")->capture_default_str();
    app.add_option("--seconds", options.limits.seconds, "processor time of a run; more is a hang")
        ->capture_default_str();
    app.add_option("--megabytes", options.limits.megabytes, "memory of a run; 0: any")
        ->capture_default_str();
    app.add_option("--attempts", options.attempts, "most steps of making a failure smaller")
        ->capture_default_str();
    app.add_option("--shown", options.shown, "failures of a kind that are printed")
        ->capture_default_str();
    app.add_option("--configs", options.configs, "folder of the shipped designs");
    app.add_option("--cameras", options.cameras, "camera file");
    Trial trial;
    add_run_command(app, trial, options);
    CLI11_PARSE(app, argc, argv);
    if (app.got_subcommand("run")) {
        return check(trial, options) ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    return search(options) ? EXIT_SUCCESS : EXIT_FAILURE;
}

} // namespace
} // namespace degs::trials

int sc_main(int argc, char* argv[]) {
    return degs::trials::run(argc, argv);
}

int main(int argc, char* argv[]) {
    ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
    return sc_core::sc_elab_and_sim(argc, argv);
}
