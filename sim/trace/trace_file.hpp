// SPDX-License-Identifier: Apache-2.0
// Timelines in the Trace Event Format, which Perfetto and chrome://tracing read.
#pragma once

#include <string>
#include <vector>

#include "modules/kit/accelerator/accelerator_result.hpp"
#include "sim/trace/power_trace.hpp"
#include "tlm/timeline.hpp"

namespace degs::sim {

/// A span of time with a name, on the first track.
struct TraceSpan {
    std::string name;
    Cycle from = 0, to = 0;
};

struct Trace {
    std::string design;
    double clock_ghz = 1;
    TimelineRecord timeline;
    std::vector<TraceSpan> spans;        ///< do not overlap, or contain each other
    std::vector<PowerSeries> power = {}; ///< by block; empty if the energy is not known
};

/// Preprocessing and blending of the run.
std::vector<TraceSpan> spans_of(const AcceleratorResult& run);
/// The whole file.
std::string trace_text(const Trace& trace);
/// Whole or not at all; throws InputError.
void write_trace(const Trace& trace, const std::string& path);

} // namespace degs::sim
