// SPDX-License-Identifier: Apache-2.0
#include "sim/trace/trace_options.hpp"

#include <filesystem>

#include "sim/shell/output_folder.hpp"

namespace degs::sim {
namespace {

// Steps are doubled, not dropped, when there would be more than these.
constexpr Cycle kFirstStep = 64;
constexpr std::size_t kUsualSteps = 2000;
constexpr std::size_t kMostSteps = 100000;

} // namespace

void add_trace_options(CLI::App& command, TraceRequest& request) {
    CLI::Option* file =
        command
            .add_option("--trace", request.file,
                        "file for a timeline of the units, the PEs, the buffers and the memory, "
                        "which https://ui.perfetto.dev opens")
            ->type_name("FILE");
    command
        .add_option("--trace-step", request.step,
                    "cycles that the timeline sums up; default: 64, doubled until at most 2000 "
                    "steps cover the run")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1000000000}))
        ->needs(file);
}

void check_writable(const std::string& file) {
    const std::filesystem::path path(file);
    const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
    const OutputFolder writable(folder, {path.filename().string()});
}

std::optional<Timeline::Config> timeline_of(const TraceRequest& request) {
    if (request.file.empty()) {
        return {};
    }
    check_writable(request.file);
    Timeline::Config config;
    config.step = request.step == 0 ? kFirstStep : request.step;
    config.most_steps = request.step == 0 ? kUsualSteps : kMostSteps;
    return config;
}

} // namespace degs::sim
