// SPDX-License-Identifier: Apache-2.0
#include "sim/run/run_options.hpp"

#include <utility>

#include <CLI/CLI.hpp>

#include "degs/error.hpp"
#include "sim/command_line/decimal_numbers.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/view_options.hpp"

namespace degs::sim {

void add_run_options(CLI::App& command, RunOptions& options) {
    add_config_option(command, options.config)->required();
    add_view_or_workload_options(command, options.view);
    add_path_options(command, options.path);
    add_group_options(command, options.path.group);
    add_foveation_option(command, options.path.group);
    command
        .add_option("--fidelity", options.fidelity,
                    "exact; strict: synchronise every cycle, the results are the same; "
                    "sampled:10%: estimate them from that share of the tiles; analytic: estimate "
                    "the time in milliseconds, without a simulation and without an image")
        ->type_name("TEXT:{exact,strict,analytic}") // what can be completed
        ->capture_default_str();
    add_sampling_options(command, options.within, options.seed);
    add_out_option(command, options.files.out, "folder for image.exr, image.png and report.json");
    add_memory_option(command, options.memory);
    add_overrides_option(command, options.overrides);
    command
        .add_option("--what-if", options.what_if,
                    "also estimate the cycles with this key changed, or with several at once: "
                    "path.to.key=value,...; may be repeated")
        ->type_name("KEY=VALUE")
        ->take_all()
        ->expected(1);
    command.add_flag("--no-reference", options.no_reference,
                     "do not render the double-precision image to compare with");
    command.add_flag("--no-cache", options.no_cache,
                     "neither read nor keep frames and reference images of earlier runs");
    command.add_flag("--array-only", options.array_only,
                     "the rasterisation array alone: sorted lists are there at once, and memory is "
                     "unlimited");
    add_trace_options(command, options.files.trace);
    add_block_log_option(command, options.files.block_log);
    add_memory_trace_option(command, options.files.memory_trace);
    command
        .add_option("--maps", options.files.maps,
                    "folder for maps of the tiles: list length, fragments, cycles, and PE-cycles "
                    "by slot class, as pictures, over the image, and as layers of tiles.exr")
        ->type_name("FOLDER");
    command.add_flag("--explain", options.explain, "print what the model left out, and why");
}

std::optional<RunOptions> run_options_of(const std::vector<std::string>& arguments) {
    RunOptions options;
    CLI::App program;
    CLI::App* command = program.add_subcommand("run");
    add_run_options(*command, options);
    require_decimal_numbers(program);
    std::vector<std::string> last_first(arguments.rbegin(), arguments.rend());
    try {
        program.parse(std::move(last_first));
    } catch (const CLI::Error&) {
        return {};
    } catch (const InputError&) {
        return {};
    }
    return command->parsed() ? std::optional(std::move(options)) : std::nullopt;
}

} // namespace degs::sim
