// SPDX-License-Identifier: Apache-2.0
// --trace: what the file says must add up to the report, in every design and both fidelities.
#include <cmath>
#include <map>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

enum { kRun = 1, kUnits, kArray, kStages, kBuffers, kMemory, kPower };

/// A design, and the options that make a run of it short and unlike the others.
struct Traced {
    const char* name;
    const char* design;
    std::vector<std::string> more;
};
std::ostream& operator<<(std::ostream& out, const Traced& traced) {
    return out << traced.name;
}

std::vector<Traced> all_traced() {
    return {
        {"degs", "degs-64", {}},
        {"degs_tuned", "degs-64-tuned", {}},
        {"degs_streams", "degs-1024-streams", {}},
        {"degs_frames", "degs-64", {"--frames", "3"}},
        {"degs_array", "degs-64", {"--array-only"}},
        {"degs_early", "degs-16", {"--set", "scheduler.scoreboard=false"}},
        {"degs_ports",
         "degs-64",
         {"--set", "pixel_buffer.ports=1", "--set", "packing.reorganisation=false"}},
        {"degs_slow", "degs-64", {"--set", "memory.bandwidth_gb_per_s=2"}},
        {"gscore", "gscore-64", {}},
        {"gscore_clusters", "gscore-64", {"--set", "array.clusters=4"}},
        {"gbu", "gbu-64", {}},
        {"gbu_probe", "gbu-64", {"--set", "engines.end_probe=true", "--frames", "2"}},
        {"gcc", "gcc-64", {}},
        {"gcc_slow",
         "gcc-64",
         {"--set", "array.discovery_cycles=6", "--set", "array.skip_cycles=2"}},
        {"lpddr5", "degs-64", {"--set", "memory.model=lpddr5"}},
    };
}

struct TraceRun {
    json trace, report;
    std::string text;
};

TraceRun traced(const Folder& folder, const Traced& design, std::vector<std::string> more) {
    std::vector<std::string> arguments{"run",
                                       config(design.design),
                                       "--scene",
                                       "synthetic:object,gaussians=1000",
                                       "--width",
                                       "200",
                                       "--no-reference",
                                       "--out",
                                       folder / "out",
                                       "--trace",
                                       folder / "trace.json"};
    arguments.insert(arguments.end(), design.more.begin(), design.more.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = degs(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::string text = read_file(folder / "trace.json");
    return {json::parse(text), report_in(folder / "out"), text};
}

/// Reads the file as a viewer does: a counter holds its value until its next event.
class Reader {
public:
    explicit Reader(const json& trace) {
        const double per_us = 1e3 * trace["otherData"]["clock_ghz"].get<double>();
        std::map<std::pair<int, std::string>, std::pair<double, double>> last;
        for (const json& event : trace["traceEvents"]) {
            const int group = event["pid"];
            if (event["ph"] == "C") {
                const auto key = std::make_pair(group, event["name"].get<std::string>());
                const double date = event["ts"].get<double>() * per_us;
                const auto before = last.find(key);
                if (before != last.end()) {
                    integrals_[key] += before->second.second * (date - before->second.first);
                }
                last[key] = {date, event["args"]["value"]};
            } else if (event["ph"] == "M" && event["name"] == "thread_name") {
                names_[{group, event["tid"]}] = event["args"]["name"];
            } else if (event["ph"] == "X" && group == kUnits) {
                for (const auto& [state, cycles] : event["args"].items()) {
                    states_[names_.at({group, event["tid"]})][state] += cycles.get<std::uint64_t>();
                }
            }
        }
    }
    /// In cycles times the counter's unit; of all counters whose name begins so.
    std::uint64_t integral(int group, const std::string& begin) const {
        double sum = 0;
        for (const auto& [key, value] : integrals_) {
            sum += key.first == group && key.second.rfind(begin, 0) == 0 ? value : 0;
        }
        return std::llround(sum);
    }
    /// In mW times cycles; of the counter of this name.
    double power(const std::string& name) const {
        const auto found = integrals_.find({kPower, name});
        return found == integrals_.end() ? 0 : found->second;
    }
    const std::map<std::string, std::map<std::string, std::uint64_t>>& states() const {
        return states_;
    }
    std::uint64_t busy(const std::string& begin) const {
        std::uint64_t sum = 0;
        for (const auto& [unit, states] : states_) {
            const auto busy = states.find("busy");
            sum += unit.rfind(begin, 0) == 0 && busy != states.end() ? busy->second : 0;
        }
        return sum;
    }

private:
    std::map<std::pair<int, int>, std::string> names_;
    std::map<std::pair<int, std::string>, double> integrals_;
    std::map<std::string, std::map<std::string, std::uint64_t>> states_;
};

/// The rings that the report shows as `buffer`.
std::string ring_of(const std::string& design, const std::string& buffer) {
    const bool plain = design.rfind("gscore", 0) == 0 || design.rfind("gcc", 0) == 0;
    return plain ? "splats" : buffer;
}

void expect_integrals_of_the_report(const Traced& design, const TraceRun& run) {
    const Reader reader(run.trace);
    for (const char* slot : {"useful", "boundary", "terminated", "conflict", "ports", "padding",
                             "starved", "blocked", "drain"}) {
        EXPECT_EQ(reader.integral(kArray, slot), run.report["slots"][slot]) << slot;
    }
    for (const auto& [name, stream] : run.report["dram"]["streams"].items()) {
        const double clock = run.report["timing"]["clock_ghz"];
        const auto bytes = [&, stage = name](const char* way) {
            return std::llround(static_cast<double>(reader.integral(kMemory, stage + way)) / clock);
        };
        EXPECT_EQ(bytes(" read"), stream["bytes_read"]) << name;
        EXPECT_EQ(bytes(" written"), stream["bytes_written"]) << name;
    }
    for (const auto& [name, buffer] : run.report["buffers"].items()) {
        if (!buffer.contains("rings")) {
            continue;
        }
        const std::string ring = ring_of(design.design, name);
        const double cells = buffer["rings"].get<double>() * buffer["depth"].get<double>();
        const double cycles = run.report["timing"]["cycles"];
        EXPECT_EQ(reader.integral(kBuffers, ring + " (of"),
                  std::llround(buffer["mean_fill"].get<double>() * cells * cycles))
            << name;
    }
}

// The power of every block integrates to its energy, and that of all to the whole.
void expect_power_of_the_energy(const TraceRun& run) {
    const Reader reader(run.trace);
    const json& energy = run.report["energy"];
    const double clock = run.report["timing"]["clock_ghz"];
    const auto nj = [&](const std::string& name) { return reader.power(name) * 1e-3 / clock; };
    constexpr double kRounding = 1e-6;
    for (const auto& [name, block] : energy["blocks"].items()) {
        const double expected =
            block["dynamic_nj"].get<double>() + block["leakage_nj"].get<double>();
        EXPECT_NEAR(nj(name), expected, kRounding * expected) << name;
    }
    const double dram = energy["dram_nj"].is_null() ? 0 : energy["dram_nj"].get<double>();
    EXPECT_NEAR(nj("memory"), dram, kRounding * dram);
    const double total = energy["total_nj"];
    EXPECT_GT(total, 0);
    EXPECT_NEAR(nj("all blocks and memory"), total, kRounding * total);
}

// A block works while its units do: none blends before the first task, and only leakage flows.
TEST(Trace, PowerFollowsTheWork) {
    const Folder folder;
    const TraceRun run = traced(folder, {"degs", "degs-64", {}}, {"--trace-step", "16"});
    const json& block = run.report["energy"]["blocks"]["blending"];
    const double us = run.report["timing"]["cycles"].get<double>() * 1e-3;
    const double leakage = block["leakage_nj"].get<double>() / us; // nJ / us = mW
    const double first = run.report["slots"]["window_first"].get<double>() * 1e-3 - 0.016;
    double before = 0, highest = 0;
    for (const json& event : run.trace["traceEvents"]) {
        if (event["ph"] == "C" && event["pid"] == kPower && event["name"] == "blending") {
            const double value = event["args"]["value"];
            before = event["ts"].get<double>() < first ? std::max(before, value) : before;
            highest = std::max(highest, value);
        }
    }
    EXPECT_NEAR(before, leakage, 1e-6 * leakage);
    EXPECT_GT(highest, 10 * leakage);
}

// Names of the units of each stage whose count of busy cycles is that of one kind of unit.
const std::map<std::string, std::map<std::string, std::string>>& units_of_stages() {
    static const std::map<std::string, std::map<std::string, std::string>> units{
        {"degs",
         {{"fetching", "fetcher_"},
          {"sorting", "sorting_"},
          {"slicing", "slicing_"},
          {"span", "span_"},
          {"packing", "bank_"},
          {"blending", "slice_"}}},
        {"gsco", {{"fetching", "fetcher_"}, {"blending", "array"}}},
        {"gbu", {{"fetching", "fetcher_"}, {"dispatch", "dispatcher"}, {"row_pes", "engine_"}}},
        {"gcc", {{"grouping", "grouping"}, {"projection", "projection"}, {"blending", "array"}}},
        {"lpdd", {{"fetching", "fetcher_"}, {"blending", "slice_"}}},
    };
    return units;
}

void expect_busy_units(const Traced& design, const TraceRun& run) {
    const Reader reader(run.trace);
    std::size_t stages = 0;
    for (const auto& [family, units] : units_of_stages()) {
        if (std::string(design.name).rfind(family, 0) == 0) {
            for (const auto& [stage, unit] : units) {
                if (run.report["stages"].contains(stage)) {
                    ++stages;
                    EXPECT_EQ(reader.busy(unit), run.report["stages"][stage]["busy_cycles"])
                        << stage;
                }
            }
        }
    }
    EXPECT_GE(stages, 2U);
}

// In every step the classes fill the part of the blending window that lies in it.
void expect_full_steps(const TraceRun& run) {
    const json& slots = run.report["slots"];
    const std::uint64_t step = run.trace["otherData"]["step_cycles"];
    const double per_us = 1e3 * run.trace["otherData"]["clock_ghz"].get<double>();
    std::vector<double> sums(run.trace["otherData"]["cycles"].get<std::uint64_t>() / step + 2, 0);
    std::map<std::string, std::pair<std::size_t, double>> last;
    for (const json& event : run.trace["traceEvents"]) {
        if (event["ph"] == "C" && event["pid"] == kArray) {
            const std::size_t at =
                std::llround(event["ts"].get<double>() * per_us / static_cast<double>(step));
            auto& before = last[event["name"]];
            for (std::size_t i = before.first; i < at; ++i) {
                sums[i] += before.second * static_cast<double>(step);
            }
            before = {at, event["args"]["value"]};
        }
    }
    const std::uint64_t first = slots["window_first"], end = slots["window_last"].get<int>() + 1;
    const std::uint64_t pes = slots["pes"];
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const std::uint64_t from = std::max(first, i * step);
        const std::uint64_t to = std::max(from, std::min(end, (i + 1) * step));
        ASSERT_EQ(std::llround(sums[i]), (to - from) * pes) << "step " << i;
    }
}

class TraceOf : public ::testing::TestWithParam<Traced> {};

TEST_P(TraceOf, AgreesWithTheReportAndWithStrict) {
    const Folder exact, strict;
    const TraceRun run = traced(exact, GetParam(), {});
    expect_integrals_of_the_report(GetParam(), run);
    expect_power_of_the_energy(run);
    expect_busy_units(GetParam(), run);
    // Several cycles of a cluster are dealt to two steps class by class.
    if (GetParam().name != std::string("gscore_clusters")) {
        expect_full_steps(run);
    }
    EXPECT_EQ(run.text, traced(strict, GetParam(), {"--fidelity", "strict"}).text);
}

INSTANTIATE_TEST_SUITE_P(Designs, TraceOf, ::testing::ValuesIn(all_traced()),
                         [](const auto& traced) { return traced.param.name; });

// The Trace Event Format: what every event must have, by its phase.
TEST(Trace, HasOnlyEventsOfTheFormat) {
    const Folder folder;
    const TraceRun run = traced(folder, all_traced().front(), {});
    EXPECT_TRUE(run.trace["traceEvents"].is_array());
    std::map<std::string, int> phases;
    std::map<std::pair<int, int>, double> end_of_track;
    for (const json& event : run.trace["traceEvents"]) {
        const std::string phase = event.at("ph");
        phases[phase]++;
        EXPECT_TRUE(event.at("name").is_string());
        EXPECT_TRUE(event.at("pid").is_number_unsigned());
        EXPECT_TRUE(event.at("tid").is_number_unsigned());
        if (phase == "M") {
            const json& value = event.at("args").begin().value();
            EXPECT_TRUE(value.is_string() || value.is_number_unsigned()) << event;
            continue;
        }
        EXPECT_GE(event.at("ts").get<double>(), 0) << event;
        if (phase == "X") {
            // Spans of a track follow each other.
            double& end = end_of_track[{event["pid"], event["tid"]}];
            EXPECT_GE(event["ts"].get<double>(), end - 1e-9) << event;
            end = event["ts"].get<double>() + event.at("dur").get<double>();
            EXPECT_GT(event["dur"].get<double>(), 0) << event;
        } else {
            EXPECT_EQ(phase, "C") << event;
            EXPECT_TRUE(event.at("args").at("value").is_number()) << event;
        }
    }
    EXPECT_GT(phases["M"], 50);
    EXPECT_GT(phases["X"], 500);
    EXPECT_GT(phases["C"], 500);
}

TEST(Trace, SumsUpAsManyCyclesAsItIsTold) {
    const Folder folder;
    const TraceRun fine = traced(folder, all_traced().front(), {"--trace-step", "50"});
    EXPECT_EQ(fine.trace["otherData"]["step_cycles"], 50);
    const TraceRun coarse = traced(folder, all_traced().front(), {"--trace-step", "1000000"});
    EXPECT_EQ(coarse.trace["otherData"]["step_cycles"], 1000000);
    EXPECT_LT(coarse.text.size(), 100000U);
    EXPECT_GT(fine.text.size(), 4 * coarse.text.size());
    EXPECT_EQ(Reader(fine.trace).states(), Reader(coarse.trace).states());
}

TEST(Trace, HasAtMostTwoThousandStepsByDefault) {
    const Folder folder;
    Traced slow = all_traced().front();
    slow.more = {"--set", "memory.bandwidth_gb_per_s=0.1"};
    const TraceRun run = traced(folder, slow, {});
    const std::uint64_t step = run.trace["otherData"]["step_cycles"];
    const std::uint64_t cycles = run.trace["otherData"]["cycles"];
    EXPECT_GT(step, 64U);
    EXPECT_LE(cycles, 2000 * step);
    EXPECT_GT(cycles, 900 * step);
    EXPECT_GE(cycles, run.report["timing"]["cycles"]);
}

TEST(Trace, ChangesNothingElse) {
    const Folder with, without;
    const Traced design = all_traced().front();
    json report = traced(with, design, {}).report;
    expect_success(degs({"run", config(design.design), "--scene", "synthetic:object,gaussians=1000",
                         "--width", "200", "--no-reference", "--out", without / "out"}));
    json plain = report_in(without / "out");
    plain.erase("host");
    report.erase("host");
    EXPECT_EQ(plain, report);
}

TEST(HostileTrace, Mistakes) {
    const Folder folder;
    const auto run = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{
            "run", config("degs-16"), "--scene", "synthetic:single", "--out", folder / "out"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return degs(arguments);
    };
    expect_mistake(run({"--trace-step", "100"}), "--trace");
    expect_mistake(run({"--trace", folder / "t.json", "--trace-step", "0"}), "--trace-step");
    expect_mistake(run({"--trace", "/dev/null/t.json"}), "/dev/null");
    expect_mistake(run({"--trace", folder / "out"}), "is not a file");
}

} // namespace
} // namespace degs::sim_test
