// SPDX-License-Identifier: Apache-2.0
#include "sim/program.hpp"

#include <iostream>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <sys/resource.h>
#include <systemc>

#include "base/visible_text.hpp"
#include "config/input_files.hpp"
#include "sim/command_line/decimal_numbers.hpp"
#include "sim/command_line/given_options.hpp"
#include "sim/command_line/help_text.hpp"
#include "sim/command_line/stated_command.hpp"
#include "sim/command_line/suggestion.hpp"
#include "sim/plot/svg.hpp"
#include "sim/process/failure.hpp"
#include "sim/process/interruption.hpp"
#include "sim/shell/commands.hpp"
#include "sim/text/standard_output.hpp"

namespace degs::sim {
namespace {

/// One line, whatever a file name or a message may contain.
int fail(int code, const std::string& words) {
    std::cerr << "degs: " << visible(words) << std::endl;
    return code;
}

/// --help and --version.
std::string answer(const CLI::App& program, const CLI::Success& question) {
    if (dynamic_cast<const CLI::CallForHelp*>(&question) == nullptr) {
        return question.what() + std::string("\n");
    }
    const CLI::App* command = &program;
    while (!command->get_subcommands().empty()) {
        command = command->get_subcommands().back();
    }
    return help_text(*command);
}

/// Runs the command that the arguments ask for.
void parse(CLI::App& program, int argc, char* argv[]) {
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& question) {
        print(answer(program, question));
    }
}

/// Libraries that are called rely on some; a program that has too little is ended without a word.
void require_stack() {
    constexpr rlim_t kLeast = rlim_t{256} << 10U;
    rlimit limit{};
    if (::getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur < kLeast) {
        throw FailureError(
            {kUserError, "The stack may have " + std::to_string(limit.rlim_cur >> 10U) +
                             " KB here, and at least " + std::to_string(kLeast >> 10U) +
                             " KB are needed; 'ulimit -s' sets the limit."});
    }
}

/// The kernel reports errors as exceptions and is silent otherwise.
void quieten_kernel() {
    using sc_core::sc_report_handler;
    sc_report_handler::set_actions(sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
    sc_report_handler::set_actions(sc_core::SC_WARNING, sc_core::SC_DO_NOTHING);
    sc_report_handler::set_actions(sc_core::SC_ERROR, sc_core::SC_THROW);
    sc_report_handler::set_actions(sc_core::SC_FATAL, sc_core::SC_THROW);
}

PreparedProgram prepared_program();

void add_commands(CLI::App& program) {
    program.require_subcommand(1);
    program.set_version_flag("--version", "degs " DEGS_VERSION);
    add_run_command(program);
    add_compare_command(program);
    add_sweep_command(program);
    add_explore_command(program);
    add_bandwidth_command(program);
    add_buffers_command(program);
    add_motion_command(program);
    add_render_command(program);
    add_scene_command(program);
    add_memory_command(program);
    add_workload_command(program);
    add_soc_command(program);
    add_config_command(program);
    add_accuracy_command(program);
    add_registers_command(program);
    add_serve_command(program, prepared_program);
    add_help_command(program);
    require_decimal_numbers(program);
}

/// Reports the exception that is being caught; returns its exit code.
int fail() {
    const Failure failure = failure_of(std::current_exception());
    return fail(failure.code, failure.sentence);
}

int run(CLI::App& program, int argc, char* argv[]) {
    try {
        spare_inputs();
        announce_interruption();
        quieten_kernel();
        when_parsed(program, [&program](const CLI::App& command) {
            refuse_combinations(command);
            state_command(stated_command(program));
        });
        parse(program, argc, argv);
        return kSuccess;
    } catch (const CLI::ParseError& error) {
        return fail(kUserError, explain_mistake(program, error));
    } catch (...) {
        return fail();
    }
}

PreparedProgram prepared_program() {
    auto program = std::make_shared<CLI::App>(
        "SystemC/TLM model of the DeGS accelerator for 3D Gaussian Splatting", "degs");
    add_commands(*program);
    return [program](int argc, char* argv[]) { return run(*program, argc, argv); };
}

} // namespace

void add_overrides_option(CLI::App& command, std::vector<std::string>& overrides,
                          const char* meaning) {
    command.add_option("--set", overrides, meaning)
        ->type_name("KEY=VALUE")
        ->take_all()
        ->expected(1);
}

void add_addressed_overrides_option(CLI::App& command, std::vector<std::string>& overrides) {
    add_overrides_option(
        command, overrides,
        "path.to.key=value for all designs, NAME:path.to.key=value for one; may be repeated");
}

int run_program(int argc, char* argv[]) {
    try {
        require_stack();
        return prepared_program()(argc, argv);
    } catch (...) {
        return fail();
    }
}

} // namespace degs::sim
