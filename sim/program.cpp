// SPDX-License-Identifier: Apache-2.0
#include "sim/program.hpp"

#include <iostream>
#include <string>

#include <CLI/CLI.hpp>
#include <systemc>

#include "config/config_words.hpp"
#include "sim/commands.hpp"
#include "sim/failure.hpp"

namespace degs::sim {
namespace {

/// One line, whatever a file name or a message may contain.
int fail(int code, const std::string& sentence) {
    std::cerr << "degs: " << config_words::one_line(sentence) << std::endl;
    return code;
}

int fail_parse(const CLI::App& program, const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
        return program.exit(error); // --help and --version
    }
    std::string reason = error.what();
    // CLI11 misses the command before it looks at what stands in its place.
    if (const auto extras = program.remaining(true); !extras.empty()) {
        reason = "'" + extras.front() + "' is not expected here";
    }
    while (!reason.empty() && (reason.back() == '.' || reason.back() == '\n')) {
        reason.pop_back();
    }
    return fail(kUserError, reason + "; 'degs --help' and 'degs COMMAND --help' tell what is "
                                     "allowed.");
}

/// The kernel reports errors as exceptions and is silent otherwise.
void quieten_kernel() {
    using sc_core::sc_report_handler;
    sc_report_handler::set_actions(sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
    sc_report_handler::set_actions(sc_core::SC_WARNING, sc_core::SC_DO_NOTHING);
    sc_report_handler::set_actions(sc_core::SC_ERROR, sc_core::SC_THROW);
    sc_report_handler::set_actions(sc_core::SC_FATAL, sc_core::SC_THROW);
}

void add_commands(CLI::App& program) {
    program.require_subcommand(1);
    program.set_version_flag("--version", "degs " DEGS_VERSION);
    add_run_command(program);
    add_compare_command(program);
    add_render_command(program);
    add_scene_command(program);
    add_memory_command(program);
    add_soc_command(program);
    add_config_command(program);
    add_accuracy_command(program);
}

} // namespace

void add_overrides_option(CLI::App& command, std::vector<std::string>& overrides) {
    command
        .add_option("--set", overrides,
                    "path.to.key=value in place of what the file says; may be repeated")
        ->take_all()
        ->expected(1);
}

int run_program(int argc, char* argv[]) {
    CLI::App program("SystemC/TLM model of the DeGS accelerator for 3D Gaussian Splatting", "degs");
    try {
        quieten_kernel();
        add_commands(program);
        program.parse(argc, argv);
        return kSuccess;
    } catch (const CLI::ParseError& error) {
        return fail_parse(program, error);
    } catch (...) {
        const Failure failure = failure_of(std::current_exception());
        return fail(failure.code, failure.sentence);
    }
}

} // namespace degs::sim
