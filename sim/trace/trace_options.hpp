// SPDX-License-Identifier: Apache-2.0
// --trace and --trace-step, for commands that simulate an accelerator.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/trace/block_log.hpp"
#include "tlm/timeline.hpp"

namespace CLI {
class App;
}

namespace degs::sim {

struct TraceRequest {
    std::string file;       ///< empty: no trace
    std::uint64_t step = 0; ///< cycles; 0: as short as a trace of moderate size allows
};

void add_trace_options(CLI::App& command, TraceRequest& request);
void add_memory_trace_option(CLI::App& command, std::string& file);
void add_block_log_option(CLI::App& command, BlockLogRequest& request);
/// Empty without --trace. Throws InputError if the file cannot be written, before a long run.
std::optional<Timeline::Config> timeline_of(const TraceRequest& request);
/// Keeps the name for the caller until the program ends. Throws InputError if no file of that name
/// can be written, or if it is an input or another output of this command.
void claim_output(const std::string& file);

} // namespace degs::sim
