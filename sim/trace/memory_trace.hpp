// SPDX-License-Identifier: Apache-2.0
// --memory-trace: the requests of an accelerator to its memory, for simulators of memories.
#pragma once

#include <functional>
#include <string>

#include "tlm/memory_request.hpp"

namespace degs::sim {

/// For a name that is not empty: throws InputError if it has no form, or if the file cannot be
/// written, before a long run.
void check_memory_trace(const std::string& file);
/// Calls `run` with a trace and writes the file whole, or not at all if `run` throws.
void write_memory_trace(const std::string& file, const std::string& design, double clock_ghz,
                        const std::function<void(RequestListener& trace)>& run);

} // namespace degs::sim
