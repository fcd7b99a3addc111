// SPDX-License-Identifier: Apache-2.0
#include "sim/memory/memory_report.hpp"

#include <nlohmann/json.hpp>

#include "base/ratio.hpp"
#include "config/config_document.hpp"
#include "sim/process/memory_use.hpp"
#include "sim/report/report.hpp"
#include "sim/report/terminal.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"
#include "stats/statistics_document.hpp"

namespace degs::sim {
namespace {

using Json = nlohmann::ordered_json;

/// Latency of reads, or of writes if there are no reads: a posted write is answered by the queue.
const LatencyHistogram& latency_of(const TrafficResult& result) {
    return result.reads.samples() != 0 ? result.reads : result.writes;
}

/// Energy per bit that was moved.
double pj_per_bit(const TrafficResult& result) {
    return mean_of(1e3 * result.energy.total_nj(), 8 * result.bytes);
}

double mean_power_w(const TrafficResult& result) {
    return 1e-9 * result.energy.total_nj() / result.seconds;
}

void describe_trace(const TraceFacts& trace, StatsVisitor& v) {
    v.text("file", trace.file, "Of the trace; what follows exists for traces only.");
    v.truth("dated", trace.dated, "Requests leave at the cycles of the trace.");
    v.real("clock_ghz", trace.dated ? std::optional(trace.clock_ghz) : std::nullopt, "GHz",
           "Of these cycles.");
    v.count("reads", trace.totals.reads, "requests", "Reads, cut where a line of 64 B ends.");
    v.count("writes", trace.totals.writes, "requests", "Writes, cut in the same way.");
    v.count("bytes_read", trace.totals.bytes_read, "bytes", "Bytes of the reads.");
    v.count("bytes_written", trace.totals.bytes_written, "bytes", "Bytes of the writes.");
}

void describe_traffic(const MemoryFacts& facts, StatsVisitor& v) {
    const TrafficShape& shape = facts.shape;
    const dram::ControllerConfig& controller = facts.memory.controller;
    v.begin_section("traffic", "Requests of the measurement.");
    v.text("pattern", facts.trace ? "trace" : shape.pattern,
           "Sequence of addresses (--pattern); trace: that of a file (--trace).");
    if (v.wants(!facts.trace)) {
        v.count("request_bytes", shape.request_bytes, "bytes", "Size of a request.");
        v.count("reads_per_write", shape.reads_per_write, "reads",
                "On average; 0 means reads only.");
        v.count("seed", shape.seed, "", "Of the random numbers.");
    }
    v.count("read_queue", controller.read_queue, "accesses", "Depth of a channel's read queue.");
    v.count("write_queue", controller.write_queue, "accesses", "Depth of its write queue.");
    v.count("requests", facts.saturated.requests, "requests", "Measured after the warm-up.");
    if (v.wants(shape.pattern == "strided")) {
        v.count("stride_bytes", shape.stride_bytes, "bytes",
                "Distance of two requests; with the pattern strided only.");
    }
    if (v.wants(facts.trace.has_value())) {
        describe_trace(facts.trace.value_or(TraceFacts()), v);
    }
    v.end_section();
}

void describe_energy(const TrafficResult& result, StatsVisitor& v) {
    v.begin_section("energy", "Energy of the DRAM by event.");
    result.energy.describe_with_unit(v);
    v.real("pj_per_bit", pj_per_bit(result), "pJ/bit", "total_nj for each bit of the requests.");
    v.real("mean_power_w", mean_power_w(result), "W", "total_nj / simulated_us / 1000.");
    v.end_section();
}

/// Results of the saturated memory.
void describe_results(const MemoryFacts& facts, StatsVisitor& v) {
    const TrafficResult& result = facts.saturated;
    describe_traffic(facts, v);
    v.real("peak_gb_per_s", facts.memory.peak_gb_per_s(), "GB/s", "Data rate x width of the bus.");
    v.count("bytes", result.bytes, "bytes",
            "Of the measured requests; of a trace in whole bursts.");
    v.real("bandwidth_gb_per_s", result.gb_per_s(), "GB/s", "bytes / simulated_us / 1000.");
    v.real("bandwidth_fraction", point_of(result, facts.memory).carried, "share",
           "bandwidth_gb_per_s / peak_gb_per_s.");
    v.real("simulated_us", result.seconds * 1e6, "us", "Time of the measurement.");
    v.section("latency_ns", latency_of(result),
              "From a request to its answer: of reads, or of writes if there are no reads.");
    v.section("write_latency_ns", result.writes, "The same of writes; posted writes answer early.");
    result.commands.describe(v);
    describe_energy(result, v);
}

/// A point of the curve.
void describe_point(const TrafficResult& result, const dram::Config& memory, StatsVisitor& v) {
    v.real("offered_fraction", result.offered, "share", "Offered load / peak_gb_per_s.");
    v.real("bandwidth_fraction", point_of(result, memory).carried, "share",
           "Bandwidth that was reached / peak_gb_per_s.");
    v.section("latency_ns", latency_of(result), "From the arrival of a request to its answer.");
}

void describe_host(const MemoryFacts& facts, StatsVisitor& v) {
    const TrafficResult& result = facts.saturated;
    v.begin_section("host", "The machine that simulated; differs between runs.");
    v.real("requests_per_s", rate_of(result.host_requests, result.host_s), "requests/s",
           "Speed of the simulation, warm-up included.");
    v.real("sim_s", result.host_s, "s", "The simulation of the saturated memory.");
    v.real("wall_s", facts.wall_s, "s", "All of it, without writing memory.json.");
    v.count("peak_rss_bytes", peak_rss_bytes(), "bytes", "Largest resident set.");
    v.end_section();
}

std::string mix_words(const TrafficShape& shape) {
    return shape.reads_per_write == 0
               ? "reads only"
               : std::to_string(shape.reads_per_write) + " read(s) per write";
}

std::string traffic_words(const MemoryFacts& facts) {
    if (facts.trace) {
        const TraceFacts& trace = *facts.trace;
        return "trace · " + grouped(trace.totals.reads) + " reads and " +
               grouped(trace.totals.writes) + " writes of up to 64 B · " +
               (trace.dated ? "at its cycles of " + decimal_text(trace.clock_ghz) + " GHz"
                            : "as fast as the memory takes them") +
               " · " + three_digits(facts.saturated.seconds * 1e6) + " us";
    }
    return facts.shape.pattern + " · " + std::to_string(facts.shape.request_bytes) + " B · " +
           mix_words(facts.shape) + " · " + grouped(facts.saturated.requests) + " requests";
}

} // namespace

LoadPoint point_of(const TrafficResult& result, const dram::Config& memory) {
    const LatencyHistogram& latency = latency_of(result);
    return {result.offered, result.gb_per_s() / memory.peak_gb_per_s(), latency.mean_ns(),
            latency.percentile_ns(0.95)};
}

void describe(const MemoryFacts& facts, StatsVisitor& v) {
    describe_results(facts, v);
    v.begin_section("curve", "A list with one entry for each offered load.");
    v.begin_section("*", "Each entry.");
    describe_point(facts.saturated, facts.memory, v);
    v.end_section();
    v.end_section();
    describe_host(facts, v);
}

Json memory_json(const MemoryFacts& facts) {
    Json json;
    json["schema"] = {{"name", "degs-memory"}, {"version", 1}};
    json["tool"] = tool_json();
    json["config"] = resolved(facts.memory);
    json.update(statistics_json(
        list_statistics([&](StatsVisitor& visitor) { describe_results(facts, visitor); })));
    json["curve"] = Json::array();
    for (const TrafficResult& each : facts.curve) {
        json["curve"].push_back(statistics_json(list_statistics(
            [&](StatsVisitor& visitor) { describe_point(each, facts.memory, visitor); })));
    }
    json.update(statistics_json(
        list_statistics([&](StatsVisitor& visitor) { describe_host(facts, visitor); })));
    return json;
}

std::string memory_words(const MemoryFacts& facts) {
    const TrafficResult& result = facts.saturated;
    const dram::Config& memory = facts.memory;
    const LatencyHistogram& latency = latency_of(result);
    std::string text = layout(
        {{"memory", facts.memory.name + " · " + std::to_string(memory.channels) + " channels · " +
                        three_decimals(memory.peak_gb_per_s()) + " GB/s"},
         {"traffic",
          traffic_words(facts) + " · queues of " + std::to_string(memory.controller.read_queue)},
         {"bandwidth", three_digits(result.gb_per_s()) + " GB/s · " +
                           percent(point_of(result, memory).carried) + " % of the peak"},
         {"latency", "mean " + three_digits(latency.mean_ns()) + " ns · 95 % within " +
                         three_digits(latency.percentile_ns(0.95)) + " ns"},
         {"rows", "hits " + percent(dram::hit_rate(result.commands.bursts)) + " % of the bursts, " +
                      percent(dram::hit_rate(result.commands.accesses)) +
                      " % of the 64 B accesses"},
         {"energy", three_digits(pj_per_bit(result)) + " pJ/bit · " +
                        three_digits(mean_power_w(result)) + " W"},
         {"host", three_digits(facts.wall_s) + " s · " +
                      scaled(rate_of(result.host_requests, result.host_s)) + " requests/s"}});
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
