// SPDX-License-Identifier: Apache-2.0
// The arguments of degs run, as they are written.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/trace/block_log.hpp"
#include "sim/trace/trace_options.hpp"
#include "sim/view/view.hpp"

namespace CLI {
class App;
}

namespace degs::sim {

/// Where the results of a run go.
struct RunFiles {
    std::string out = "out";  ///< folder
    std::string maps;         ///< folder; empty: none
    std::string memory_trace; ///< file; empty: none
    TraceRequest trace;
    BlockLogRequest block_log;
};

struct RunOptions {
    std::string config, memory;
    std::vector<std::string> overrides, what_if;
    ViewRequest view;
    PathRequest path;
    std::string fidelity = "exact";
    std::optional<std::string> within;
    std::uint64_t seed = 1;
    bool no_reference = false;
    bool no_cache = false;
    bool array_only = false;
    bool explain = false;
    RunFiles files;
};

void add_run_options(CLI::App& command, RunOptions& options);
/// The options of the command line "run ..." without the name of the program; nothing if it is no
/// line of `degs run`, or one with a mistake.
std::optional<RunOptions> run_options_of(const std::vector<std::string>& arguments);

} // namespace degs::sim
