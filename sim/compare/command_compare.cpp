// SPDX-License-Identifier: Apache-2.0
// degs compare: several accelerators on the same views.
#include <memory>

#include "base/visible_text.hpp"
#include "sim/compare/compare_session.hpp"
#include "sim/compare/comparison_output.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/study/study_options.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/warnings.hpp"

namespace degs::sim {
namespace {

struct CompareOptions {
    std::vector<std::string> configs, overrides;
    ViewOptions views;
    std::string memory;
    int jobs = 1;
    bool equal_area = false;
    std::string out = "out";
};

CompareRequest request_of(const CompareOptions& options) {
    LoadedConfigs loaded =
        load_compared(options.configs, options.overrides, options.views.quick, options.memory);
    replace_views(options.views, loaded.views);
    CompareRequest request;
    request.configs = std::move(loaded.configs);
    put_views(loaded.views, request);
    request.sampling = sampling_for_runs(options.views.within, options.views.seed);
    request.jobs = options.jobs;
    check_estimates(request);
    cameras_by_scene(request); // a mistake is found before anything runs
    return request;
}

void run(const CompareOptions& options) {
    const CompareRequest request = request_of(options);
    const OutputFolder out(options.out, comparison_files());
    std::size_t shown = 0; // views
    const auto show = [&shown](const Comparison& now, std::size_t views) {
        print(views_text(now, shown, views));
        shown = views;
    };
    CompareSession session(request, out, show,
                           options.equal_area ? AreaScale::Equal : AreaScale::Own);
    const Comparison comparison = session.run();
    print(views_text(comparison, shown, comparison.views.size()) +
          (options.equal_area ? equal_area_text(comparison) : "") + closing_text(comparison));
    if (!comparison.rows.empty()) {
        print("all numbers and pictures: " + visible(out.path("")) + "\n");
    }
    print_warnings(session.warnings());
    if (const std::optional<Failure> failure = session.failure()) {
        throw FailureError(*failure);
    }
}

void add_what_options(CLI::App& command, CompareOptions& options) {
    command
        .add_option("config", options.configs,
                    "configuration files (YAML), each as FILE or NAME=FILE, or studies without "
                    "axes; the others are compared with the first")
        ->type_name("FILE")
        ->required();
    add_study_view_options(command, options.views);
    add_addressed_overrides_option(command, options.overrides);
    add_memory_option(command, options.memory);
}

} // namespace

void add_compare_command(CLI::App& program) {
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command =
        program.add_subcommand("compare", "compare accelerators on the same frames");
    add_what_options(*command, *options);
    command->add_flag("--equal-area", options->equal_area,
                      "also compare as if every configuration took the area of the first: a table, "
                      "and ratios.svg");
    add_jobs_option(*command, options->jobs);
    add_out_option(*command, options->out, "folder for tables, pictures and reports");
    command->callback([options] { run(*options); });
}

} // namespace degs::sim
