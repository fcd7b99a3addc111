// SPDX-License-Identifier: Apache-2.0
#include "sim/memory/memory_report.hpp"

#include <nlohmann/json.hpp>

#include "config/config_document.hpp"
#include "sim/report.hpp"
#include "sim/text/terminal.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

using Json = nlohmann::ordered_json;

Json latency_json(const LatencyHistogram& latency) {
    return {{"mean", latency.mean_ns()},          {"p50", latency.percentile_ns(0.5)},
            {"p95", latency.percentile_ns(0.95)}, {"p99", latency.percentile_ns(0.99)},
            {"max", latency.largest_ns()},        {"samples", latency.samples()}};
}

Json commands_json(const dram::Channel::Stats& stats) {
    Json json;
    for (std::size_t c = 0; c < dram::kCommands; ++c) {
        json[dram::command_name(static_cast<dram::Command>(c))] = stats.commands[c];
    }
    return json;
}

Json rows_json(const std::array<std::uint64_t, 3>& counts) {
    return {{"hits", counts[0]}, {"closed", counts[1]}, {"conflicts", counts[2]}};
}

Json energy_json(const TrafficResult& result) {
    const dram::Energy& energy = result.energy;
    return {{"activate_nj", energy.activate_nj},
            {"read_nj", energy.read_nj},
            {"write_nj", energy.write_nj},
            {"refresh_nj", energy.refresh_nj},
            {"background_nj", energy.background_nj},
            {"total_nj", energy.total_nj()},
            {"pj_per_bit", 1e3 * energy.total_nj() / (8.0 * static_cast<double>(result.bytes))},
            {"mean_power_w", 1e-9 * energy.total_nj() / result.seconds}};
}

Json shape_json(const TrafficShape& shape, const dram::ControllerConfig& controller,
                std::uint64_t requests) {
    Json json{{"pattern", shape.pattern},
              {"request_bytes", shape.request_bytes},
              {"reads_per_write", shape.reads_per_write},
              {"read_queue", controller.read_queue},
              {"write_queue", controller.write_queue},
              {"requests", requests},
              {"seed", shape.seed}};
    if (shape.pattern == "strided") {
        json["stride_bytes"] = shape.stride_bytes;
    }
    return json;
}

std::string mix_words(const TrafficShape& shape) {
    return shape.reads_per_write == 0
               ? "reads only"
               : std::to_string(shape.reads_per_write) + " read(s) per write";
}

} // namespace

const LatencyHistogram& latency_of(const TrafficResult& result) {
    return result.reads.samples() != 0 ? result.reads : result.writes;
}

LoadPoint point_of(const TrafficResult& result, const dram::Config& memory) {
    const LatencyHistogram& latency = latency_of(result);
    return {result.offered, result.gb_per_s() / memory.peak_gb_per_s(), latency.mean_ns(),
            latency.percentile_ns(0.95)};
}

Json memory_json(const MemoryFacts& facts) {
    const TrafficResult& result = facts.saturated;
    Json json;
    json["schema"] = {{"name", "degs-memory"}, {"version", 1}};
    json["tool"] = tool_json();
    json["config"] = resolved(facts.memory);
    json["traffic"] = shape_json(facts.shape, facts.memory.controller, result.requests);
    json["peak_gb_per_s"] = facts.memory.peak_gb_per_s();
    json["bandwidth_gb_per_s"] = result.gb_per_s();
    json["bandwidth_fraction"] = point_of(result, facts.memory).carried;
    json["simulated_us"] = result.seconds * 1e6;
    json["latency_ns"] = latency_json(latency_of(result));
    json["write_latency_ns"] = latency_json(result.writes);
    json["row_hit_rate"] = dram::hit_rate(result.commands.bursts);
    json["access_hit_rate"] = dram::hit_rate(result.commands.accesses);
    json["bursts"] = rows_json(result.commands.bursts);
    json["accesses"] = rows_json(result.commands.accesses);
    json["forwarded"] = result.commands.forwarded;
    json["merged"] = result.commands.merged;
    json["commands"] = commands_json(result.commands);
    json["energy"] = energy_json(result);
    json["curve"] = Json::array();
    for (const TrafficResult& each : facts.curve) {
        json["curve"].push_back({{"offered_fraction", each.offered},
                                 {"bandwidth_fraction", point_of(each, facts.memory).carried},
                                 {"latency_ns", latency_json(latency_of(each))}});
    }
    json["host"] = {{"requests_per_s", static_cast<double>(result.host_requests) / result.host_s},
                    {"sim_s", result.host_s},
                    {"wall_s", facts.wall_s},
                    {"peak_rss_bytes", peak_rss_bytes()}};
    return json;
}

std::string memory_words(const MemoryFacts& facts) {
    const TrafficResult& result = facts.saturated;
    const dram::Config& memory = facts.memory;
    const LatencyHistogram& latency = latency_of(result);
    std::string text = layout(
        {{"memory", facts.memory.name + " · " + std::to_string(memory.channels) + " channels · " +
                        as_typed(memory.peak_gb_per_s()) + " GB/s"},
         {"traffic", facts.shape.pattern + " · " + std::to_string(facts.shape.request_bytes) +
                         " B · " + mix_words(facts.shape) + " · " + grouped(result.requests) +
                         " requests · queues of " + std::to_string(memory.controller.read_queue)},
         {"bandwidth", three_digits(result.gb_per_s()) + " GB/s · " +
                           percent(point_of(result, memory).carried) + " % of the peak"},
         {"latency", "mean " + three_digits(latency.mean_ns()) + " ns · 95 % within " +
                         three_digits(latency.percentile_ns(0.95)) + " ns"},
         {"rows", "hits " + percent(dram::hit_rate(result.commands.bursts)) + " % of the bursts, " +
                      percent(dram::hit_rate(result.commands.accesses)) +
                      " % of the 64 B accesses"},
         {"energy",
          three_digits(1e3 * result.energy.total_nj() / (8.0 * static_cast<double>(result.bytes))) +
              " pJ/bit · " + three_digits(1e-9 * result.energy.total_nj() / result.seconds) + " W"},
         {"host", three_digits(facts.wall_s) + " s · " +
                      scaled(static_cast<double>(result.host_requests) / result.host_s) +
                      " requests/s"}});
    if (!facts.curve.empty()) {
        TextTable table({"offered %", "carried %", "mean ns", "p95 ns"});
        for (const TrafficResult& each : facts.curve) {
            const LoadPoint point = point_of(each, memory);
            table.add({percent(point.offered, 0), percent(point.carried),
                       three_digits(point.mean_ns), three_digits(point.p95_ns)});
        }
        text += "\n" + table.text();
    }
    return text;
}

} // namespace degs::sim
