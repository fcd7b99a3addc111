// SPDX-License-Identifier: Apache-2.0
// --memory-trace: the requests of an accelerator to its memory, for simulators of memories.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <ostream>
#include <queue>
#include <string>
#include <vector>

#include "tlm/memory_request.hpp"

namespace degs::sim {

/// The two forms of docs/workload.md.
enum class MemoryTraceForm {
    LoadStore, ///< LoadStoreTrace of Ramulator 2: `LD 0x40` for a line of 64 B, without dates
    Stl        ///< STL of DRAMSys: `12: (64) read 0x40`
};

/// By the end of the name: `.ldst` or `.stl`. InputError for any other.
MemoryTraceForm memory_trace_form(const std::string& file);

/// Writes requests in the order of their dates, as the memory serves them: equal dates by the
/// number of the initiator. A request is cut where a line of 64 B ends.
class MemoryTrace : public RequestListener {
public:
    /// `out` must outlive the trace.
    MemoryTrace(std::ostream& out, MemoryTraceForm form, const std::string& design,
                double clock_ghz);

    void initiator(const std::string& name) override { names_.push_back(name); }
    void request(const MemoryRequest& request) override;
    /// Writes what is left, when nothing follows.
    void close();

private:
    struct Pending {
        MemoryRequest request;
        std::uint64_t sequence;
        bool operator>(const Pending& other) const;
    };
    void write_before(Cycle date);
    void write(const MemoryRequest& request);
    void write_line(const MemoryRequest& request, std::uint64_t begin, std::uint64_t end);

    std::ostream* out_;
    MemoryTraceForm form_;
    ClockDomain clock_;
    std::vector<std::string> names_; // by initiator
    std::priority_queue<Pending, std::vector<Pending>, std::greater<>> pending_;
    std::uint64_t sequence_ = 0;
    Cycle written_ = 0; // no request dated before may follow
};

/// For a name that is not empty: throws InputError if it has no form, or if the file cannot be
/// written, before a long run.
void check_memory_trace(const std::string& file);
/// Calls `run` with a trace and writes the file whole, or not at all if `run` throws.
void write_memory_trace(const std::string& file, const std::string& design, double clock_ghz,
                        const std::function<void(RequestListener& trace)>& run);

} // namespace degs::sim
