// SPDX-License-Identifier: Apache-2.0
// Memory traces that degs memory --trace replays; docs/workload.md describes their forms.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "scene/files/input_file.hpp"

namespace degs::sim {

/// At most 64 bytes of a request, inside one line of 64 B.
struct TraceAccess {
    std::uint64_t cycle = 0; ///< 0 in a trace without dates
    std::uint64_t address = 0, bytes = 0;
    bool write = false;
};

/// Reads a trace line by line. Whatever is wrong with it is an InputError that names the file, the
/// line and the reason.
class TraceReader {
public:
    /// `capacity`: bytes of the memory, where addresses end.
    TraceReader(const std::string& path, std::uint64_t capacity);

    /// The next access; false at the end.
    bool next(TraceAccess& access);
    const std::string& path() const { return file_.path(); }
    /// Goes back to the beginning.
    void rewind();
    /// Requests carry the cycle at which they leave. Known after the first request.
    bool dated() const { return dated_; }
    /// The clock that the trace itself names, before its first request.
    std::optional<double> clock_ghz() const { return clock_ghz_; }

private:
    bool read_line(std::string& line);
    bool fill();
    void parse(std::string_view line);
    void parse_comment(std::string_view line);
    void parse_load_store(std::string_view line);
    void parse_stl(std::string_view line);
    void check_request();
    [[noreturn]] void fail(const std::string& reason) const;

    InputWatch watch_; ///< the trace is read twice
    InputFile file_;
    std::uint64_t capacity_;
    std::array<char, 65536> block_{};
    std::size_t used_ = 0, filled_ = 0; // bytes of block_
    std::uint64_t line_ = 0;
    bool dated_ = false, form_known_ = false;
    std::optional<double> clock_ghz_;
    TraceAccess request_; // of the line
    std::uint64_t last_cycle_ = 0;
};

/// What a trace holds.
struct TraceTotals {
    std::uint64_t reads = 0, writes = 0; ///< accesses
    std::uint64_t bytes_read = 0, bytes_written = 0;
    std::uint64_t accesses() const { return reads + writes; }
};

/// Reads the whole trace and rewinds it. InputError if it holds no request.
TraceTotals total_of(TraceReader& trace);

} // namespace degs::sim
