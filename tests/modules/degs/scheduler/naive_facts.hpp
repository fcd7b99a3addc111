// SPDX-License-Identifier: Apache-2.0
// What the naive blocks of a bank share.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace degs::test {

using Number = std::int64_t;

/// What a log says about its bank.
class NaiveFacts {
    std::map<std::string, Number> facts_;
    Number fact(const char* name) const { return facts_.at(name); }

public:
    explicit NaiveFacts(std::map<std::string, Number> facts) : facts_(std::move(facts)) {}
    Number bank = fact("bank");
    Number banks = fact("banks");
    Number contexts = fact("contexts");
    Number feature_entries = fact("feature_entries");
    Number fill_cycles = fact("fill_cycles");
    Number fill_ports = fact("fill_ports");
    Number fill_sram_banks = fact("fill_sram_banks");
    Number first_context = fact("first_context");
    Number granted = fact("granted");
    Number inputs = fact("inputs");
    Number issue_width = fact("issue_width");
    Number open_splats = fact("open_splats");
    Number packet_latency = fact("packet_latency");
    Number packet_tasks = fact("packet_tasks");
    Number packets_per_cycle = fact("packets_per_cycle");
    Number packets_waiting = fact("packets_waiting");
    Number queue_depth = fact("queue_depth");
    Number reorganisation = fact("reorganisation");
    Number reuse_cycles = fact("reuse_cycles");
    Number scan = fact("scan");
    Number scoreboard = fact("scoreboard");
    Number select_cycles = fact("select_cycles");
    Number segment_length = fact("segment_length");
    Number segments_per_cycle = fact("segments_per_cycle");
    Number spans_per_cycle = fact("spans_per_cycle");
    Number streams = fact("streams");
    Number termination = fact("termination");
    Number tile_size = fact("tile_size");
    Number tiles_in_flight = fact("tiles_in_flight");
};

/// What a block does, in lines of numbers.
class NaiveLines {
public:
    void say(Number now, const char* what, const std::vector<Number>& numbers) {
        std::string line = std::to_string(now) + " " + what;
        for (const Number number : numbers) {
            line += " " + std::to_string(number);
        }
        lines_.push_back(line);
    }
    const std::vector<std::string>& lines() const { return lines_; }

private:
    std::vector<std::string> lines_;
};

/// A segment of a row in a bank.
struct NaiveSegment {
    Number tile, context, domain, splat, row, column, sequence, entry;
    std::uint32_t mask;
};

} // namespace degs::test
