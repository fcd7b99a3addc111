// SPDX-License-Identifier: Apache-2.0
#include "sim/trace/trace_options.hpp"

#include <filesystem>
#include <list>

#include <CLI/App.hpp>

#include "sim/shell/output_folder.hpp"

namespace degs::sim {
namespace {

// Steps are doubled, not dropped, when there would be more than these.
constexpr Cycle kFirstStep = 64;
constexpr std::size_t kUsualSteps = 2000;
constexpr std::size_t kMostSteps = 100000;

} // namespace

void add_trace_options(CLI::App& command, TraceRequest& request) {
    command
        .add_option("--trace", request.file,
                    "file for a timeline of the units, the PEs, the buffers and the memory, "
                    "which https://ui.perfetto.dev opens")
        ->type_name("FILE");
    command
        .add_option("--trace-step", request.step,
                    "cycles that the timeline sums up; default: 64, doubled until at most 2000 "
                    "steps cover the run")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1000000000}));
}

void add_memory_trace_option(CLI::App& command, std::string& file) {
    command
        .add_option("--memory-trace", file,
                    "file for every request to memory: name.stl, as DRAMSys reads it, or "
                    "name.ldst, as Ramulator 2 does")
        ->type_name("FILE");
}

void add_block_log_option(CLI::App& command, BlockLogRequest& request) {
    command
        .add_option("--block-log", request.words,
                    "block, for instance bank:3, and file for everything that goes in and out of "
                    "it; the run is strict, whose dates are those of exact")
        ->expected(2)
        ->type_name("BLOCK FILE");
}

void claim_output(const std::string& file) {
    static std::list<OutputFolder> claimed; // until the program ends
    const std::string name = std::filesystem::path(file).filename().string();
    claimed.emplace_back(parent_folder(file), std::vector<std::string>{name});
}

std::optional<Timeline::Config> timeline_of(const TraceRequest& request) {
    if (request.file.empty()) {
        return {};
    }
    claim_output(request.file);
    Timeline::Config config;
    config.step = request.step == 0 ? kFirstStep : request.step;
    config.most_steps = request.step == 0 ? kUsualSteps : kMostSteps;
    return config;
}

} // namespace degs::sim
