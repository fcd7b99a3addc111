// SPDX-License-Identifier: Apache-2.0
// degs serve: commands without a process start each.
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <system_error>

#include <unistd.h>

#include "base/parallel.hpp"
#include "base/visible_text.hpp"
#include "sim/process/failure.hpp"
#include "sim/run/run_view.hpp"
#include "sim/serve/server.hpp"
#include "sim/shell/commands.hpp"

namespace degs::sim {
namespace {

/// This process is in the folder of a request while it lives.
class Visit {
public:
    explicit Visit(const std::string& folder) : before_(std::filesystem::current_path(error_)) {
        if (!folder.empty()) {
            std::filesystem::current_path(folder, error_);
        }
    }
    ~Visit() {
        std::error_code ignored;
        std::filesystem::current_path(before_, ignored);
    }
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;

    /// Why the folder cannot be entered, if it cannot.
    const std::error_code& error() const { return error_; }

private:
    std::error_code error_;
    std::filesystem::path before_;
};

/// In a fork: what the program does with these arguments.
WorkEnd run_request(const Request& request, const PreparedProgram& program) {
    const Visit visit(request.folder);
    if (visit.error()) {
        std::cerr << "degs: The folder '" << visible(request.folder)
                  << "' of the request cannot be entered: " << visit.error().message() << "."
                  << std::endl;
        return {kUserError};
    }
    std::vector<std::string> words{"degs"};
    words.insert(words.end(), request.arguments.begin(), request.arguments.end());
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) {
        argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    const int code = program(static_cast<int>(words.size()), argv.data());
    return {code, missed_view()};
}

/// Keeps the view of a request.
void keep(const Request& request) {
    const Visit visit(request.folder);
    try {
        keep_view_of(request.arguments);
    } catch (const std::exception&) {
        // Files may have changed since. The next request makes its view itself, or says what is
        // wrong.
        return;
    }
}

} // namespace

void add_serve_command(CLI::App& program, const std::function<PreparedProgram()>& prepare) {
    auto jobs = std::make_shared<std::optional<int>>();
    CLI::App* command = program.add_subcommand(
        "serve", "run commands that come as lines of JSON, with the projected views in memory");
    command
        ->add_option("--jobs", *jobs,
                     "requests at a time, each in its own process; default: one for each processor")
        ->check(CLI::Range(1, 256));
    command->callback([jobs, prepare] {
        const PreparedProgram prepared = prepare();
        const auto run = [&prepared](const Request& request) {
            return run_request(request, prepared);
        };
        Server server(STDIN_FILENO, STDOUT_FILENO, jobs->value_or(host_threads()), {run, keep});
        server.serve();
    });
}

} // namespace degs::sim
