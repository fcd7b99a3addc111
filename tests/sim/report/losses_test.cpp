// SPDX-License-Identifier: Apache-2.0
// The reasons that `degs run` names, where they are known by construction, and the keys that move them.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>

#include <nlohmann/json.hpp>

#include "sim/report/losses.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

/// The line of a run's summary that begins with `name`.
std::string line_of(const std::string& text, const std::string& name) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind(name + " ", 0) == 0) {
            return line.substr(line.find_first_not_of(' ', name.size()));
        }
    }
    ADD_FAILURE() << "no line '" << name << "' in\n" << text;
    return "";
}

std::string losses_of_run(const std::string& design, const std::string& scene,
                          const std::vector<std::string>& sets,
                          const std::vector<std::string>& more = {}) {
    const Folder folder;
    std::vector<std::string> arguments{"run",   config(design), "--scene",       scene,
                                       "--out", folder / "out", "--no-reference"};
    for (const std::string& set : sets) {
        arguments.insert(arguments.end(), {"--set", set});
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = degs(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return line_of(outcome.out, "losses");
}

/// The share of a reason in the line, %; 0 if it is not among the three.
double share_of(const std::string& line, const std::string& reason) {
    const std::size_t at = line.find(reason + " ");
    return at == std::string::npos ? 0 : std::stod(line.substr(at + reason.size()));
}

void expect_first(const std::string& line, const std::string& reason, const std::string& key) {
    EXPECT_EQ(line.rfind(reason + " ", 0), 0U) << line;
    const std::string first = line.substr(0, line.find(" · "));
    EXPECT_NE(first.find(key), std::string::npos) << line;
}

const std::string kObject = "synthetic:object,gaussians=2000";
const std::vector<std::string> kSmall{"--width", "240"};

TEST(Losses, OneSpanUnitStarvesTheArray) {
    const std::string line =
        losses_of_run("degs-64", kObject, {"span.count=1", "slicing.count=1"}, kSmall);
    expect_first(line, "starved, for span", "raise span.count");
    const std::string better = losses_of_run("degs-64", kObject, {"span.count=4"}, kSmall);
    EXPECT_LT(share_of(better, "starved, for span"), 0.7 * share_of(line, "starved, for span"));
}

TEST(Losses, SlowMemoryIsNamedForEveryAccelerator) {
    for (const char* design : {"degs-64", "gscore-64", "gbu-64", "gcc-64"}) {
        SCOPED_TRACE(design);
        const std::string line =
            losses_of_run(design, kObject, {"memory.bandwidth_gb_per_s=1"}, kSmall);
        const std::string first = line.substr(0, line.find(" · "));
        EXPECT_NE(first.find("for memory"), std::string::npos) << line;
        EXPECT_NE(first.find("raise memory.bandwidth_gb_per_s"), std::string::npos) << line;
    }
}

TEST(Losses, KeysOfAnotherMemoryModelAreNotNamed) {
    const std::string line = losses_of_run(
        "degs-64", kObject, {"memory.model=lpddr5", "memory.lpddr5.channels=1"}, kSmall);
    EXPECT_NE(line.find("raise memory.lpddr5.channels"), std::string::npos) << line;
    EXPECT_EQ(line.find("bandwidth_gb_per_s"), std::string::npos) << line;
    const std::string alone =
        losses_of_run("degs-64", kObject, {}, {"--width", "240", "--array-only"});
    EXPECT_EQ(alone.find("memory"), std::string::npos) << alone;
}

// The waiting segments share it with the packets: with few of them there is nothing to choose from.
TEST(Losses, ATinyPackingBufferLeavesNoChoice) {
    const std::string filled = "scheduler.queue_segments_per_pe=0";
    const std::string line =
        losses_of_run("degs-64", kObject, {filled, "packing.bytes=3840"}, kSmall);
    expect_first(line, "conflict", "raise packing.bytes");
    EXPECT_NE(line.find("starved"), std::string::npos) << line;
    EXPECT_EQ(line.find("raise scheduler.queue_segments_per_pe"), std::string::npos) << line;
    const std::string better =
        losses_of_run("degs-64", kObject, {filled, "packing.bytes=32768"}, kSmall);
    EXPECT_LT(share_of(better, "conflict"), share_of(line, "conflict") / 2) << better;
    // Where the keys limit the segments and packets, bytes move nothing.
    const std::string plain = losses_of_run("degs-64", kObject, {}, kSmall);
    EXPECT_EQ(plain.find("packing.bytes"), std::string::npos) << plain;
}

// One in the rows of each bank, or the other banks would have nothing to do.
TEST(Losses, HotPixelsConflict) {
    const Folder folder;
    std::vector<Splat> splats(16000);
    for (std::size_t i = 0; i < splats.size(); ++i) {
        splats[i].mean = {0, static_cast<float>(i % 8) * 4 / 60, 0};
        splats[i].scale = {-7, -7, -7};
        splats[i].opacity = -4; // nearly transparent, so that all of them are blended
    }
    write_ply(folder / "hot.ply", splats);
    write_camera(folder / "cameras.json", {0, 0, -4});
    const std::string line = losses_of_run("degs-64", folder / "hot.ply", {});
    expect_first(line, "conflict", "lower scheduler.reuse_cycles");
    const std::string better = losses_of_run(
        "degs-64", folder / "hot.ply", {"scheduler.reuse_cycles=2", "array.writeback_cycles=2"});
    EXPECT_LT(share_of(better, "conflict"), share_of(line, "conflict"));
}

TEST(Losses, KeysAtTheirBestAreNotNamed) {
    const std::vector<std::string> sets{"scheduler.termination=pixel", "pipeline.span_ends=exact"};
    const std::string line = losses_of_run("degs-64", kObject, sets, kSmall);
    EXPECT_EQ(line.find("scheduler.termination"), std::string::npos) << line;
    EXPECT_EQ(line.find("span_ends"), std::string::npos) << line;
    const std::string gbu = losses_of_run("gbu-64", kObject, {"engines.end_probe=false"}, kSmall);
    EXPECT_EQ(gbu.find("end_probe"), std::string::npos) << gbu;
}

using Settings = std::vector<std::string>;

/// The report of a small run; nothing if the design is refused.
std::optional<nlohmann::ordered_json> report_with(const std::string& design,
                                                  const Settings& settings) {
    const Folder folder;
    Settings arguments{"run", config(design), "--scene",      kObject,         "--width",
                       "240", "--out",        folder / "out", "--no-reference"};
    for (const std::string& setting : settings) {
        arguments.insert(arguments.end(), {"--set", setting});
    }
    return degs(arguments).code == 0 ? std::optional(report_in(folder / "out")) : std::nullopt;
}

/// PE-cycles lost in the class or the time of a reason, whatever they were lost for.
double lost_for(const nlohmann::ordered_json& report, const std::string& reason) {
    const auto first_words = [](const std::string& words) {
        return words.substr(0, words.find(','));
    };
    double cycles = 0;
    for (const auto& loss : report["losses"]) {
        if (first_words(loss["reason"]) == first_words(reason)) {
            cycles += loss["share"].get<double>() * report["timing"]["cycles"].get<double>();
        }
    }
    return cycles;
}

double value_in(const nlohmann::ordered_json& report, const std::string& key) {
    std::string pointer = "/config/" + key;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    return report.at(nlohmann::ordered_json::json_pointer(pointer)).get<double>();
}

/// What the advice "raise KEY", "lower KEY and KEY" or "KEY=VALUE" can mean.
std::vector<Settings> steps_of(const std::string& advice, const nlohmann::ordered_json& report) {
    const std::size_t space = advice.find(' ');
    if (space == std::string::npos) {
        return {{advice}};
    }
    const auto moved = [&](const std::string& key, double factor) {
        const double now = value_in(report, key);
        const double to = advice[0] == 'r' ? std::max(now, 1.0) * factor : std::floor(now / factor);
        std::ostringstream text;
        text << key << '=' << std::setprecision(12) << to;
        return text.str();
    };
    const std::size_t linked = advice.find(" and ");
    const std::string key = advice.substr(space + 1, linked - space - 1);
    std::vector<Settings> steps;
    for (const double factor : {2.0, 4.0, 8.0, 16.0}) {
        if (linked == std::string::npos) {
            steps.push_back({moved(key, factor)});
        } else {
            const std::string other = advice.substr(linked + 5);
            steps.push_back({moved(key, factor), moved(other, factor)});
            steps.push_back({moved(key, factor), moved(other, factor * factor)});
        }
    }
    return steps;
}

struct Situation {
    const char* name;
    const char* design;
    Settings settings;
};

class Advice : public ::testing::TestWithParam<Situation> {};

// Some advice for a loss lowers it and does not lengthen the frame, and every key can be moved.
TEST_P(Advice, LowersTheLoss) {
    const auto& [name, design, settings] = GetParam();
    const auto before = report_with(design, settings);
    ASSERT_TRUE(before);
    int followed = 0;
    for (const auto& loss : (*before)["losses"]) {
        const std::string reason = loss["reason"];
        if (loss["share"] < 0.05 || loss["keys"].empty()) {
            continue;
        }
        const double lost = lost_for(*before, reason);
        double least = lost;
        for (const std::string advice : loss["keys"]) {
            bool can_move = false;
            for (const Settings& step : steps_of(advice, *before)) {
                Settings with = settings;
                with.insert(with.end(), step.begin(), step.end());
                const auto after = report_with(design, with);
                can_move = can_move || after;
                if (after && (*after)["timing"]["cycles"] <= (*before)["timing"]["cycles"]) {
                    least = std::min(least, lost_for(*after, reason));
                }
            }
            EXPECT_TRUE(can_move) << reason << ": " << advice;
        }
        EXPECT_LT(least, 0.95 * lost) << reason << ": " << loss["keys"];
        ++followed;
    }
    EXPECT_GT(followed, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Situations, Advice,
    ::testing::Values(
        Situation{"degs", "degs-64", {}}, Situation{"gscore", "gscore-64", {}},
        Situation{"gbu", "gbu-64", {}}, Situation{"gcc", "gcc-64", {}},
        Situation{"degs_tuned", "degs-64-tuned", {}}, Situation{"orange", "orange-o1", {}},
        Situation{"orange_cores", "orange-o4", {}},
        Situation{"orange_few_lanes", "orange-o1", {"cores.vector.lanes=64"}},
        Situation{"degs_fast_memory", "degs-64", {"memory.bandwidth_gb_per_s=2000"}},
        Situation{"gscore_fast_memory", "gscore-64", {"memory.bandwidth_gb_per_s=2000"}},
        Situation{"gbu_fast_memory", "gbu-64", {"memory.bandwidth_gb_per_s=2000"}},
        Situation{"gcc_slow_memory", "gcc-64", {"memory.bandwidth_gb_per_s=20"}},
        Situation{"degs_few_slicing_units", "degs-64", {"slicing.count=1", "memory.latency_ns=0"}},
        Situation{"degs_slow_sorting", "degs-64", {"sorting.keys_per_cycle=1", "sorting.count=1"}},
        Situation{"degs_small_pixel_buffer", "degs-64", {"pixel_buffer.readout_pixels=1"}},
        Situation{"degs_few_ports", "degs-64", {"pixel_buffer.ports=1"}}),
    [](const auto& situation) { return situation.param.name; });

// The vector units keep ORANGE's array waiting, and more arrays behind the same lanes would wait more.
TEST(Losses, OfOrangeNameTheVectorUnitsAndNotTheArray) {
    const std::string line = losses_of_run("orange-o1", kObject, {"cores.vector.lanes=64"}, kSmall);
    expect_first(line, "starved, for vector_units", "raise cores.vector.lanes");
    EXPECT_EQ(line.find("systolic_arrays"), std::string::npos) << line;
    EXPECT_EQ(line.find("cores.count"), std::string::npos) << line;
}

// Useful cycles and losses fill PEs x cycles.
TEST(Losses, AddUp) {
    sim::RunResult result;
    AcceleratorResult& run = result.accelerator;
    run.pes = 4;
    run.cycles = 100;
    run.window.include(10);
    run.window.include(89);
    run.slots.useful = 200;
    run.slots.conflict = 70;
    run.slots.starved = 30;
    run.slots.drain = 20;
    const std::vector<sim::Loss> losses = sim::losses_of(result);
    double sum = 0.5;
    for (const sim::Loss& loss : losses) {
        sum += loss.share;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_EQ(losses.front().reason, "conflict");
    EXPECT_NEAR(losses.front().share, 70.0 / 400, 1e-12);
    EXPECT_EQ(sim::losses_line(sim::RunResult()), "none");
}

} // namespace
} // namespace degs::sim_test
