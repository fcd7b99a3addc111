// SPDX-License-Identifier: Apache-2.0
#include "sim/trace/memory_trace.hpp"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <ostream>
#include <queue>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "degs/error.hpp"
#include "scene/files/input_file.hpp"
#include "scene/files/output_file.hpp"
#include "sim/text/words.hpp"
#include "sim/trace/trace_options.hpp"

namespace degs::sim {
namespace {

constexpr std::uint64_t kLineBytes = 64;

/// The two forms of docs/workload.md.
enum class MemoryTraceForm {
    LoadStore, ///< LoadStoreTrace of Ramulator 2: `LD 0x40` for a line of 64 B, without dates
    Stl        ///< STL of DRAMSys: `12: (64) read 0x40`
};

bool ends_with(const std::string& text, const std::string& end) {
    return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// By the end of the name: `.ldst` or `.stl`. InputError for any other.
MemoryTraceForm memory_trace_form(const std::string& file) {
    if (ends_with(file, ".stl")) {
        return MemoryTraceForm::Stl;
    }
    if (ends_with(file, ".ldst")) {
        return MemoryTraceForm::LoadStore;
    }
    throw InputError("--memory-trace: the name '" + file +
                     "' must end in .stl, the form of DRAMSys, or in .ldst, that of Ramulator 2.");
}

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

bool MemoryTrace::Pending::operator>(const Pending& other) const {
    return std::tie(request.date, request.initiator, sequence) >
           std::tie(other.request.date, other.request.initiator, other.sequence);
}

MemoryTrace::MemoryTrace(std::ostream& out, MemoryTraceForm form, const std::string& design,
                         double clock_ghz)
    : out_(&out), form_(form), clock_(clock_ghz) {
    if (form == MemoryTraceForm::Stl) { // The other form has no comments.
        out << "# " << design << "\n# clock_ghz " << decimal_text(clock_ghz) << "\n";
    }
}

// A process may be ahead of the kernel, so requests come out of order; none comes that is dated
// before the kernel's cycle.
void MemoryTrace::request(const MemoryRequest& request) {
    if (request.date < written_) {
        throw std::logic_error("the model is broken, a request of cycle " +
                               std::to_string(request.date) + " comes after cycle " +
                               std::to_string(written_));
    }
    pending_.push({request, sequence_++});
    write_before(clock_.floor(sc_core::sc_time_stamp()));
}

void MemoryTrace::close() {
    write_before(kNever);
}

void MemoryTrace::write_before(Cycle date) {
    written_ = std::max(written_, date);
    while (!pending_.empty() && pending_.top().request.date < date) {
        write(pending_.top().request);
        pending_.pop();
    }
}

void MemoryTrace::write(const MemoryRequest& request) {
    const std::uint64_t end = request.address + request.bytes;
    for (std::uint64_t at = request.address; at < end;) {
        const std::uint64_t next = std::min(end, at / kLineBytes * kLineBytes + kLineBytes);
        write_line(request, at, next);
        at = next;
    }
}

void MemoryTrace::write_line(const MemoryRequest& request, std::uint64_t begin, std::uint64_t end) {
    std::array<char, 96> line{};
    if (form_ == MemoryTraceForm::LoadStore) {
        std::snprintf(line.data(), line.size(), "%s 0x%" PRIx64 "\n", request.write ? "ST" : "LD",
                      begin / kLineBytes * kLineBytes);
        *out_ << line.data();
        return;
    }
    std::snprintf(line.data(), line.size(), "%" PRIu64 ": (%" PRIu64 ") %s 0x%" PRIx64 " # ",
                  request.date, end - begin, request.write ? "write" : "read", begin);
    *out_ << line.data() << names_[request.initiator] << '\n';
}

} // namespace

void check_memory_trace(const std::string& file) {
    memory_trace_form(file);
    claim_output(file);
}

void write_memory_trace(const std::string& file, const std::string& design, double clock_ghz,
                        const std::function<void(RequestListener& trace)>& run) {
    write_whole(file, [&](std::ostream& out) {
        MemoryTrace trace(out, memory_trace_form(file), design, clock_ghz);
        run(trace);
        trace.close();
    });
}

} // namespace degs::sim
