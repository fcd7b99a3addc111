// SPDX-License-Identifier: Apache-2.0
#include "sim/memory/trace_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace degs::sim {
namespace {

constexpr std::uint64_t kTraceLineBytes = 64;
constexpr std::uint64_t kMostBytes = 1U << 20U;
constexpr std::size_t kLongestLine = 4096;
/// The replay adds latencies to a cycle and multiplies it by the length of one in ps.
constexpr std::uint64_t kLastCycle = std::uint64_t{1} << 40U;
constexpr const char* kBlanks = " \t\r";

/// Takes the first word off `line`; empty at its end.
std::string_view take_word(std::string_view& line) {
    const std::size_t begin = std::min(line.find_first_not_of(kBlanks), line.size());
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
    const std::string_view word = line.substr(0, end);
    line.remove_prefix(end);
    return word;
}

/// A whole number of which nothing is left over.
std::optional<std::uint64_t> number_of(std::string_view word, int base) {
    std::uint64_t value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value, base);
    return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

bool is_hexadecimal(std::string_view word) {
    return word.size() > 2 && word[0] == '0' && (word[1] == 'x' || word[1] == 'X');
}

} // namespace

TraceReader::TraceReader(const std::string& path, std::uint64_t capacity)
    : file_(path), capacity_(capacity) {}

void TraceReader::rewind() {
    file_.seek(0);
    used_ = filled_ = 0;
    line_ = 0;
    request_ = {};
    last_cycle_ = 0;
}

void TraceReader::fail(const std::string& reason) const {
    fail_file(file_.path(), "line " + std::to_string(line_) + ": " + reason);
}

bool TraceReader::next(TraceAccess& access) {
    std::string line;
    while (request_.bytes == 0) {
        if (!read_line(line)) {
            return false;
        }
        parse(line);
    }
    access = request_;
    access.bytes = std::min(request_.bytes, kTraceLineBytes - request_.address % kTraceLineBytes);
    request_.address += access.bytes;
    request_.bytes -= access.bytes;
    return true;
}

bool TraceReader::fill() {
    const bool first = file_.position() == 0;
    filled_ = file_.read_some(block_.data(), block_.size());
    const bool marked =
        first &&
        std::string_view(block_.data(), filled_).substr(0, kByteOrderMark.size()) == kByteOrderMark;
    used_ = marked ? kByteOrderMark.size() : 0;
    watch_.require_unchanged();
    return filled_ != 0;
}

/// False at the end of the file.
bool TraceReader::read_line(std::string& line) {
    line.clear();
    if (used_ == filled_ && !fill()) {
        return false;
    }
    ++line_;
    do {
        const auto* const begin = block_.data() + used_;
        const auto* const end = block_.data() + filled_;
        const auto* const stop = std::find(begin, end, '\n');
        line.append(begin, stop);
        if (line.size() > kLongestLine) {
            fail("the line is longer than " + std::to_string(kLongestLine) +
                 " characters, which no line of a memory trace is.");
        }
        used_ += stop - begin;
        if (stop != end) {
            ++used_;
            return true;
        }
    } while (fill());
    return true;
}

void TraceReader::parse(std::string_view line) {
    std::string_view rest = line;
    const std::string_view word = take_word(rest);
    if (word.empty()) {
        return;
    }
    if (word.front() == '#') {
        parse_comment(line);
        return;
    }
    const bool dated = word != "LD" && word != "ST";
    if (form_known_ && dated != dated_) {
        fail("the line has another form than those above; a trace is either LD and ST with an "
             "address, or 'cycle: read' and 'write'.");
    }
    dated_ = dated;
    form_known_ = true;
    dated ? parse_stl(line) : parse_load_store(line);
    check_request();
}

void TraceReader::parse_comment(std::string_view line) {
    if (form_known_) {
        return;
    }
    take_word(line);
    if (take_word(line) != "clock_ghz") {
        return;
    }
    const std::string text(take_word(line));
    char* end = nullptr;
    const double clock = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(clock >= 0.001) || !(clock <= 100)) {
        fail("the clock must be a number of GHz from 0.001 to 100, not " + in_quotes(text) + ".");
    }
    clock_ghz_ = clock;
}

void TraceReader::parse_load_store(std::string_view line) {
    request_ = {};
    request_.write = take_word(line) == "ST";
    std::string_view word = take_word(line);
    const std::string_view whole = word;
    const int base = is_hexadecimal(word) ? 16 : 10;
    word.remove_prefix(base == 16 ? 2 : 0);
    const std::optional<std::uint64_t> address = number_of(word, base);
    if (!address) {
        fail("the address " + in_quotes(whole) + " is not a number, such as 0x1f40.");
    }
    if (const std::string_view more = take_word(line); !more.empty()) {
        fail("LD or ST and an address stand on a line, and " + in_quotes(more) + " follows them.");
    }
    request_.address = *address / kTraceLineBytes * kTraceLineBytes;
    request_.bytes = kTraceLineBytes;
}

void TraceReader::parse_stl(std::string_view line) {
    request_ = {};
    std::string_view word = take_word(line);
    const bool colon = word.back() == ':';
    const auto cycle = number_of(word.substr(0, word.size() - (colon ? 1 : 0)), 10);
    if (!cycle || !colon) {
        fail("a line begins with LD, ST or a cycle and a colon, such as '12:', not with " +
             in_quotes(word) + ".");
    }
    request_.cycle = *cycle;
    request_.bytes = kTraceLineBytes;
    word = take_word(line);
    if (!word.empty() && word.front() == '(') {
        const auto bytes = number_of(word.substr(1, word.size() < 3 ? 0 : word.size() - 2), 10);
        if (!bytes || word.back() != ')' || *bytes == 0 || *bytes > kMostBytes) {
            fail("the bytes must be a number from 1 to " + std::to_string(kMostBytes) +
                 " in parentheses, such as (64), not " + in_quotes(word) + ".");
        }
        request_.bytes = *bytes;
        word = take_word(line);
    }
    if (word != "read" && word != "write") {
        fail("the command must be read or write, not " + in_quotes(word) + ".");
    }
    request_.write = word == "write";
    word = take_word(line); // What follows the address is data or a comment.
    const auto address = number_of(word.substr(is_hexadecimal(word) ? 2 : 0), 16);
    if (!address) {
        fail("the address " + in_quotes(word) + " is not a hexadecimal number, such as 0x1f40.");
    }
    request_.address = *address;
}

void TraceReader::check_request() {
    if (request_.address >= capacity_ || request_.bytes > capacity_ - request_.address) {
        fail("the request of " + std::to_string(request_.bytes) + " bytes at address " +
             std::to_string(request_.address) + " ends beyond the memory, which has " +
             std::to_string(capacity_) + " bytes.");
    }
    if (request_.cycle > kLastCycle) {
        fail("the cycle " + std::to_string(request_.cycle) + " is later than " +
             std::to_string(kLastCycle) + ", the last one that can be replayed.");
    }
    if (request_.cycle < last_cycle_) {
        fail("the cycle " + std::to_string(request_.cycle) + " is before " +
             std::to_string(last_cycle_) + ", that of the request above it.");
    }
    last_cycle_ = request_.cycle;
}

TraceTotals total_of(TraceReader& trace) {
    TraceTotals totals;
    TraceAccess access;
    while (trace.next(access)) {
        ++(access.write ? totals.writes : totals.reads);
        (access.write ? totals.bytes_written : totals.bytes_read) += access.bytes;
    }
    if (totals.accesses() == 0) {
        fail_file(trace.path(), "the trace holds no request.");
    }
    trace.rewind();
    return totals;
}

} // namespace degs::sim
