// SPDX-License-Identifier: Apache-2.0
// Results of degs memory, as JSON and as text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "sim/memory/memory_traffic.hpp"
#include "sim/memory/trace_reader.hpp"
#include "sim/plot/plot_svg.hpp"

namespace degs::sim {

/// A trace that is replayed in place of a pattern.
struct TraceFacts {
    std::string file;
    bool dated = false;
    double clock_ghz = 1; ///< if it has dates
    TraceTotals totals;   ///< as they stand in the file
};

struct MemoryFacts {
    dram::Config memory;
    TrafficShape shape;
    std::optional<TraceFacts> trace;
    TrafficResult saturated;
    std::vector<TrafficResult> curve; ///< by offered load
    double wall_s = 0;
};

LoadPoint point_of(const TrafficResult& result, const dram::Config& memory);
/// The numbers of memory.json, with their units and what they mean. "curve.*" stands for every
/// entry of the curve; its values are those of the saturated memory.
void describe(const MemoryFacts& facts, StatsVisitor& visitor);
nlohmann::ordered_json memory_json(const MemoryFacts& facts);
std::string memory_words(const MemoryFacts& facts);

} // namespace degs::sim
