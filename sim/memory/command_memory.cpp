// SPDX-License-Identifier: Apache-2.0
// degs memory: bandwidth and latency of a memory alone, under a pattern or a trace.
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "config/config_source.hpp"
#include "config/input_files.hpp"
#include "degs/error.hpp"
#include "sim/memory/memory_report.hpp"
#include "sim/memory/trace_replay.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/standard_output.hpp"

namespace degs::sim {
namespace {

struct MemoryOptions {
    std::string trace;               ///< file; empty: none
    std::optional<double> trace_ghz; ///< of its cycles
    std::string config;
    std::vector<std::string> overrides;
    TrafficShape shape;
    std::uint64_t requests = 200000;
    bool no_curve = false;
    std::string out = "out";
};

dram::Config load(const MemoryOptions& options) {
    dram::Config config;
    ConfigSource::from_file(options.config, options.overrides).load(config);
    // The traffic itself bounds what waits in a closed loop; with an offered load, or the dates of
    // a trace, nothing does.
    constexpr int kMostTraceRequests = 65536;
    config.waiting_requests = options.trace.empty()
                                  ? traffic_window(config, options.shape.request_bytes)
                                  : kMostTraceRequests;
    return config;
}

/// A twentieth, then tenths of the peak until the memory does not follow.
void measure_curve(MemoryTraffic& traffic, const MemoryOptions& options, MemoryFacts& facts,
                   Progress& progress) {
    constexpr double kFollows = 0.97;
    constexpr int kPoints = 11;
    for (int i = 0; i < kPoints; ++i) {
        const double offered = i == 0 ? 0.05 : i + 1 == kPoints ? 0.95 : 0.1 * i;
        facts.curve.push_back(traffic.measure(options.requests / 5 + 1, offered));
        progress.done((1.0 + i) / kPoints);
        if (point_of(facts.curve.back(), facts.memory).carried < kFollows * offered) {
            return;
        }
    }
}

void write_results(const MemoryOptions& options, const MemoryFacts& facts,
                   const OutputFolder& out) {
    if (!facts.curve.empty()) {
        std::vector<LoadPoint> points;
        for (const TrafficResult& each : facts.curve) {
            points.push_back(point_of(each, facts.memory));
        }
        out.write_text("latency.svg",
                       load_latency_svg(facts.memory.name + ": " + options.shape.pattern +
                                            ", latency over load",
                                        points));
    }
    out.write_json("memory.json", memory_json(facts));
}

void measure(const MemoryOptions& options, dram::Lpddr5& memory, MemoryFacts& facts) {
    const dram::Config& config = facts.memory;
    if (std::uint64_t{4} * options.shape.request_bytes > memory.channels().mapping().capacity()) {
        throw InputError("Requests of " + std::to_string(options.shape.request_bytes) +
                         " bytes are too large for this memory.");
    }
    MemoryTraffic traffic("traffic", memory, config, options.shape);
    Progress progress("memory traffic");
    facts.saturated = traffic.measure(options.requests, 0);
    if (!options.no_curve) {
        measure_curve(traffic, options, facts, progress);
    }
}

void replay(const MemoryOptions& options, dram::Lpddr5& memory, MemoryFacts& facts) {
    TraceReader reader(options.trace, memory.channels().mapping().capacity());
    TraceFacts trace;
    trace.file = options.trace;
    trace.totals = total_of(reader);
    trace.dated = reader.dated();
    if (options.trace_ghz && !trace.dated) {
        throw InputError("--trace-ghz: the trace " + options.trace + " has no cycles.");
    }
    trace.clock_ghz = options.trace_ghz.value_or(reader.clock_ghz().value_or(1.0));
    TraceReplay traffic("traffic", memory, facts.memory, reader, trace.clock_ghz);
    Progress progress("memory trace");
    facts.saturated = traffic.run(trace.totals.accesses(), progress);
    facts.trace = trace;
}

void run(const MemoryOptions& options) {
    const Stopwatch wall;
    MemoryFacts facts;
    facts.memory = load(options);
    facts.shape = options.shape;
    const dram::Config& config = facts.memory;
    if (!options.trace.empty()) {
        remember_input(options.trace); // the folder refuses to replace it
    }
    const OutputFolder out(options.out, {"memory.json", "latency.svg"});
    dram::Lpddr5 memory("memory", config, Timebase(), config.channels);
    if (!options.trace.empty()) {
        replay(options, memory, facts);
    } else {
        measure(options, memory, facts);
    }
    facts.wall_s = wall.seconds();
    out.replace([&] { write_results(options, facts, out); });
    print(memory_words(facts));
}

void add_traffic_options(CLI::App& command, TrafficShape& shape) {
    command
        .add_option("--pattern", shape.pattern,
                    "stream; stream4: four streams 256 MiB apart; strided: the first bytes of "
                    "every stride; random: uniform, aligned to 64 B")
        ->check(CLI::IsMember(traffic_patterns()))
        ->capture_default_str();
    command.add_option("--request-bytes", shape.request_bytes, "size of a request")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
    command.add_option("--stride-bytes", shape.stride_bytes, "distance, pattern strided")
        ->check(CLI::Range(1, 1 << 26))
        ->capture_default_str();
    command
        .add_option("--reads-per-write", shape.reads_per_write,
                    "reads per write, on average and in random order; 0: reads only")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    command.add_option("--seed", shape.seed, "seed of the random numbers")->capture_default_str();
}

void add_replay_options(CLI::App& command, MemoryOptions& options) {
    command
        .add_option("--trace", options.trace,
                    "replay the requests of a file in place of a pattern: LoadStoreTrace of "
                    "Ramulator 2, or STL of DRAMSys")
        ->type_name("FILE");
    command
        .add_option("--trace-ghz", options.trace_ghz,
                    "clock of the cycles of an STL trace; default: the one that the trace names, "
                    "or 1")
        ->check(CLI::Range(0.001, 100.0));
}

} // namespace

void add_memory_command(CLI::App& program) {
    auto options = std::make_shared<MemoryOptions>();
    CLI::App* command = program.add_subcommand(
        "memory", "measure bandwidth and latency of a memory under synthetic traffic or a trace");
    command->add_option("config", options->config, "configuration file of a memory (YAML)")
        ->type_name("FILE")
        ->required();
    add_traffic_options(*command, options->shape);
    command->add_option("--requests", options->requests, "requests to measure after the warm-up")
        ->check(CLI::Range(std::uint64_t{1000}, std::uint64_t{1} << 40U))
        ->capture_default_str();
    command->add_flag("--no-curve", options->no_curve, "do not measure latency over load");
    add_replay_options(*command, *options);
    add_out_option(*command, options->out, "folder for memory.json and latency.svg");
    add_overrides_option(*command, options->overrides);
    command->callback([options] { run(*options); });
}

} // namespace degs::sim
