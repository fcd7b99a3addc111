// SPDX-License-Identifier: Apache-2.0
// degs run: one frame, or a camera path, on one accelerator.
#include <memory>

#include <nlohmann/json.hpp>

#include "sim/analytic/analytic_run.hpp"
#include "sim/report/report.hpp"
#include "sim/report/terminal.hpp"
#include "sim/report/what_if_words.hpp"
#include "sim/run/run_outputs.hpp"
#include "sim/run/run_simulation.hpp"
#include "sim/run/run_view.hpp"
#include "sim/shell/commands.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/warnings.hpp"

namespace degs::sim {
namespace {

void estimate(const RunPlan& plan, CachedView& view, const RunFiles& files) {
    const OutputFolder out(files.out, image_result_files("analytic.json"));
    const AnalyticRun run = run_analytic(plan.request.config, view, plan.changed);
    out.replace([&] { out.write_json("analytic.json", analytic_json(run)); },
                files_of_earlier_run(out, std::nullopt, 1));
    print_warnings(run.warnings);
    print(analytic_text(run));
}

void run(const RunOptions& options) {
    const Stopwatch since_start;
    RunPlan plan = plan_of(options);
    const std::shared_ptr<CachedView> seen = view_of(plan);
    CachedView& view = *seen;
    if (plan.analytic) {
        return estimate(plan, view, options.files);
    }
    RunOutputs outputs(options.files, plan.path.group.images());
    plan.request.views = view.views();
    plan.request.recording = outputs.recording();
    const RunResult result = outputs.write(plan.request.config, [&](RequestListener* requests) {
        plan.request.build.requests = requests;
        return simulate(plan, view, since_start);
    });
    print_warnings(result.warnings);
    print(summary(result, outputs.image()) + what_if_text(result.what_if) +
          (options.explain ? explanation(result) : ""));
}

} // namespace

void add_run_command(CLI::App& program) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* command =
        program.add_subcommand("run", "simulate a frame or a camera path on an accelerator");
    add_run_options(*command, *options);
    command->callback([options] { run(*options); });
}

} // namespace degs::sim
