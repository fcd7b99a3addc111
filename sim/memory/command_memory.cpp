// SPDX-License-Identifier: Apache-2.0
// degs memory: bandwidth and latency of a memory alone.
#include <memory>

#include <nlohmann/json.hpp>

#include "config/config_source.hpp"
#include "degs/error.hpp"
#include "sim/memory/memory_report.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/standard_output.hpp"

namespace degs::sim {
namespace {

struct MemoryOptions {
    std::string config;
    std::vector<std::string> overrides;
    TrafficShape shape;
    int queue = 0;
    std::uint64_t requests = 200000;
    bool no_curve = false;
    std::string out = "out";
};

dram::Config load(const MemoryOptions& options) {
    dram::Config config;
    ConfigSource::from_file(options.config, options.overrides).load(config);
    if (options.queue != 0) {
        config.controller.read_queue = options.queue;
        config.controller.write_queue = options.queue;
    }
    // The traffic itself bounds what waits in a closed loop; with an offered load nothing does.
    config.waiting_requests = traffic_window(config, options.shape.request_bytes);
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
    if (!options.no_curve) {
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

void run(const MemoryOptions& options) {
    const Stopwatch wall;
    MemoryFacts facts;
    facts.memory = load(options);
    facts.shape = options.shape;
    const dram::Config& config = facts.memory;
    const OutputFolder out(options.out, {"memory.json", "latency.svg"});
    dram::Lpddr5 memory("memory", config, Timebase(), config.channels);
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

} // namespace

void add_memory_command(CLI::App& program) {
    auto options = std::make_shared<MemoryOptions>();
    CLI::App* command = program.add_subcommand(
        "memory", "measure bandwidth and latency of a memory under synthetic traffic");
    command->add_option("config", options->config, "configuration file of a memory (YAML)")
        ->type_name("FILE")
        ->required();
    add_traffic_options(*command, options->shape);
    command
        ->add_option("--queue", options->queue,
                     "depth of each controller queue per channel, in 64 B; default: the file's")
        ->check(CLI::Range(1, static_cast<int>(dram::Queue::kSlots)));
    command->add_option("--requests", options->requests, "requests to measure after the warm-up")
        ->check(CLI::Range(std::uint64_t{1000}, std::uint64_t{1} << 40U))
        ->capture_default_str();
    command->add_flag("--no-curve", options->no_curve, "do not measure latency over load");
    add_out_option(*command, options->out, "folder for memory.json and latency.svg");
    add_overrides_option(*command, options->overrides);
    command->callback([options] { run(*options); });
}

} // namespace degs::sim
