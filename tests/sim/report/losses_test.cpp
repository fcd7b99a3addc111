// SPDX-License-Identifier: Apache-2.0
// The reasons that `degs run` names, where they are known by construction, and the keys that move
// them.
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "sim/report/losses.hpp"
#include "sim/simulation/loss_keys.hpp"
#include "sim/text/words.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using namespace degs::sim;

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

/// The three largest losses of a run with all keys that they name, as the summary has them where no
/// gain is known.
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
    const std::string said = line_of(outcome.out, "losses");
    std::string text;
    const nlohmann::json report = report_in(folder / "out"), losses = report["losses"];
    for (const nlohmann::json& gain : report.value("gains", nlohmann::json::array())) {
        EXPECT_NE(said.find(gain["change"].get<std::string>() + " gains "), std::string::npos)
            << said;
    }
    for (std::size_t l = 0; l < std::min<std::size_t>(losses.size(), 3); ++l) {
        const std::string reason = losses[l]["reason"];
        EXPECT_NE(said.find(reason), std::string::npos) << said;
        std::string keys;
        for (const std::string key : losses[l]["keys"]) {
            keys += (keys.empty() ? "" : " or ") + key;
        }
        text += (text.empty() ? "" : " · ") + reason + " " +
                percent(losses[l]["share"].get<double>()) + " % (" +
                (keys.empty() ? "no key is known to move it" : keys) + ")";
    }
    return text;
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

// Gains exist for a design with an analytic model, and not for its array alone.
TEST(Losses, AreReportedWithWhatTheirChangesGain) {
    const auto report = [](const std::vector<std::string>& more) {
        const Folder folder;
        std::vector<std::string> words{
            "run", config("degs-64"), "--scene", kObject,       "--width",
            "240", "--no-reference",  "--out",   folder / "out"};
        words.insert(words.end(), more.begin(), more.end());
        expect_success(degs(words));
        return report_in(folder / "out");
    };
    const nlohmann::json whole = report({});
    ASSERT_TRUE(whole.contains("gains"));
    for (const nlohmann::json& gain : whole["gains"]) {
        const nlohmann::json asked = report({"--what-if", gain["change"].get<std::string>()});
        EXPECT_NEAR(gain["gain"].get<double>(),
                    1 - asked["what_if"][0]["estimated_after"].get<double>() /
                            asked["what_if"][0]["estimated_before"].get<double>(),
                    1e-12);
    }
    EXPECT_FALSE(report({"--array-only"}).contains("gains"));
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
// LPDDR5 has no use for the bus's latency, so that it decides no cause either.
TEST(Losses, TheLatencyOfTheBusSaysNothingAboutLpddr5) {
    for (const char* const design : {"degs-64", "gscore-64", "gbu-64", "orange-o2"}) {
        const auto losses = [&](const std::string& latency) {
            const Folder folder;
            const Outcome outcome =
                degs({"run", config(design), "--scene", kObject, "--width", "240", "--memory",
                      config("memory/lpddr5-6400x256"), "--no-reference", "--set",
                      "memory.latency_ns=" + latency, "--out", folder / "out"});
            EXPECT_EQ(outcome.code, 0) << outcome.err;
            return report_in(folder / "out")["losses"];
        };
        const nlohmann::json expected = losses("0");
        EXPECT_FALSE(expected.empty());
        EXPECT_EQ(losses("100"), expected) << design;
        EXPECT_EQ(losses("5000"), expected) << design;
    }
}

TEST(Losses, ATinyPackingBufferLeavesNoChoice) {
    const std::string filled = "scheduler.queue_segments_per_pe=0", lists = "pipeline.tiles=exact";
    const std::string line =
        losses_of_run("degs-64", kObject, {lists, filled, "packing.bytes=3840"}, kSmall);
    expect_first(line, "conflict", "raise packing.bytes");
    EXPECT_NE(line.find("starved"), std::string::npos) << line;
    EXPECT_EQ(line.find("raise scheduler.queue_segments_per_pe"), std::string::npos) << line;
    const std::string better =
        losses_of_run("degs-64", kObject, {lists, filled, "packing.bytes=32768"}, kSmall);
    EXPECT_LT(share_of(better, "conflict"), share_of(line, "conflict") / 2) << better;
    // Where the keys limit the segments and packets, bytes move nothing.
    const std::string plain = losses_of_run("degs-64", kObject, {lists}, kSmall);
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

// GCC colours all groups but the first beside its array: no colour keeps the first task waiting for
// long.
TEST(Losses, TheFirstTaskOfGccWaitsForStageOne) {
    for (const char* more : {"memory.latency_ns=100", "clusters=2", "view_size=64"}) {
        SCOPED_TRACE(more);
        const std::string line =
            losses_of_run("gcc-64", kObject, {"grouping.means_per_cycle=1", more}, kSmall);
        EXPECT_NE(line.find("before the first task, for grouping"), std::string::npos) << line;
        EXPECT_NE(line.find("raise grouping.means_per_cycle"), std::string::npos) << line;
    }
}

// Buffers and lanes would not shorten what waits for a late answer. The bus itself is hardly busy.
TEST(Losses, OfASlowMemoryNameItsLatency) {
    for (const char* design : {"degs-64-tuned", "gscore-64", "gbu-64", "gcc-64", "orange-o1"}) {
        SCOPED_TRACE(design);
        const std::string line = losses_of_run(design, kObject, {"memory.latency_ns=4000"}, kSmall);
        const std::size_t at = line.find("starved");
        ASSERT_NE(at, std::string::npos) << line;
        const std::string part = line.substr(at, line.find(" · ", at) - at);
        EXPECT_EQ(part.rfind("starved, for the latency of memory ", 0), 0U) << line;
        EXPECT_NE(part.find("lower memory.latency_ns"), std::string::npos) << line;
        const std::string none = losses_of_run(design, kObject, {"memory.latency_ns=0"}, kSmall);
        EXPECT_EQ(none.find("latency of memory"), std::string::npos) << none;
    }
}

// A buffer that reads out faster than the memory takes pixels is no cause.
TEST(Losses, AfterTheLastTaskTheSlowerOfMemoryAndReadoutCounts) {
    for (const char* const bandwidth : {"50", "2000"}) {
        const std::string memory = std::string("memory.bandwidth_gb_per_s=") + bandwidth;
        const Folder folder;
        const Outcome outcome =
            degs({"run", config("gcc-256"), "--scene", kObject, "--width", "240", "--no-reference",
                  "--set", memory, "--set", "memory.latency_ns=0", "--out", folder / "out"});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        for (const auto& loss : report_in(folder / "out")["losses"]) {
            if (loss["reason"] == "after the last task") {
                EXPECT_NE(loss["keys"].dump().find(*bandwidth == '5' ? "bandwidth" : "readout"),
                          std::string::npos)
                    << loss;
            }
        }
    }
}

// A loss that depends on the shape of the array and on the picture alone.
TEST(Losses, WithoutAKeySayThatNoneMovesThem) {
    for (const char* design : {"gcc-64", "gscore-64", "gbu-64"}) {
        const std::string line = losses_of_run(design, kObject, {}, kSmall);
        const std::string loss = design == std::string("gcc-64") ? "boundary" : "terminated";
        const std::size_t at = line.find(loss + " ");
        ASSERT_NE(at, std::string::npos) << line;
        const std::string part = line.substr(at, line.find(" · ", at) - at);
        EXPECT_NE(part.find("(no key is known to move it)"), std::string::npos) << line;
    }
}

// The vector units keep ORANGE's array waiting, and more arrays behind the same lanes would wait
// more.
TEST(Losses, OfOrangeNameTheVectorUnitsAndNotTheArray) {
    const std::string line = losses_of_run("orange-o1", kObject, {"cores.vector.lanes=64"}, kSmall);
    expect_first(line, "starved, for vector_units", "raise cores.vector.lanes");
    EXPECT_EQ(line.find("systolic_arrays"), std::string::npos) << line;
    EXPECT_EQ(line.find("cores.count"), std::string::npos) << line;
}

/// A list of keys has one with these words.
auto IsNamed(const std::string& words) {
    return testing::Contains(testing::Field(&LossStep::words, words));
}

/// Frames of so many views of 100 x 100 pixels, whose last ones take as long as all tasks do.
RunResult waiting_for_pixels(std::size_t views, std::size_t frames, double gb_per_s) {
    RunResult result;
    result.camera.width = result.camera.height = 100;
    result.workload.pixels = std::uint64_t{100} * 100;
    for (std::size_t v = 0; views > 1 && v < views; ++v) {
        result.views.push_back({result.camera, result.workload, {}});
    }
    AcceleratorResult& run = result.accelerator;
    run.pes = 64;
    run.cycles = run.memory_window = 2000;
    run.window.include(0);
    run.window.include(999);
    run.slots[Slot::Useful] = std::uint64_t{64} * 1000;
    run.frames.resize(frames);
    run.memory_gb_per_s = gb_per_s;
    run.readout_pixels = 16; // of 4 B, in cycles of 1 ns
    run.streams.resize(1);
    run.streams[0].name = "frame_buffer";
    run.streams[0].bytes_written = frames * views * result.workload.pixels * 4;
    result.movable_keys = LossKeys(result).movable();
    return result;
}

TEST(Losses, OfPixelsComeFromTheSlowerOfReadoutAndMemoryForAnyNumberOfViews) {
    for (const auto& [views, frames] : {std::pair(1, 1), {2, 1}, {8, 1}, {1, 3}, {2, 3}}) {
        const std::vector<Loss> reads_out = losses_of(waiting_for_pixels(views, frames, 65));
        ASSERT_EQ(reads_out.size(), 1U);
        EXPECT_EQ(reads_out[0].reason, "after the last task");
        EXPECT_DOUBLE_EQ(reads_out[0].share, 0.5);
        EXPECT_THAT(reads_out[0].keys, IsNamed("raise pixel_buffer.readout_pixels"));
        const std::vector<Loss> writes = losses_of(waiting_for_pixels(views, frames, 63));
        ASSERT_EQ(writes.size(), 1U);
        EXPECT_THAT(writes[0].keys, IsNamed("raise memory.bandwidth_gb_per_s"));
    }
}

// To mend one of two stages that take almost as long would leave the other.
TEST(Losses, BeforeTheFirstTaskNameAllThatTakeAlmostAsLong) {
    RunResult result;
    AcceleratorResult& run = result.accelerator;
    run.pes = 64;
    run.cycles = run.memory_window = 1000;
    run.window.include(500);
    run.window.include(999);
    run.slots[Slot::Useful] = std::uint64_t{64} * 500;
    for (const auto& [name, cycles] :
         {std::pair("projection", 450.0), {"sorting", 410.0}, {"fetching", 390.0}}) {
        StageUse stage;
        stage.name = name;
        stage.units = 1;
        stage.busy_cycles = cycles; // 90 %, 82 % and 78 % of the time before the first task
        stage.prepares = 1;
        run.stages.push_back(stage);
    }
    const std::vector<Loss> losses = losses_of(result);
    ASSERT_EQ(losses.size(), 1U);
    EXPECT_EQ(losses[0].reason, "before the first task, for projection and sorting");
    EXPECT_DOUBLE_EQ(losses[0].share, 0.5);
}

// Useful cycles and losses fill PEs x cycles.
TEST(Losses, AddUp) {
    sim::RunResult result;
    AcceleratorResult& run = result.accelerator;
    run.pes = 4;
    run.cycles = 100;
    run.window.include(10);
    run.window.include(89);
    run.slots[Slot::Useful] = 200;
    run.slots[Slot::Conflict] = 70;
    run.slots[Slot::Starved] = 30;
    run.slots[Slot::Drain] = 20;
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

TEST(Losses, NameTheChangeThatGainsMost) {
    const Loss loss{"conflict", 0.5, {{"raise a", "a=2"}, {"raise b", "b=4"}}};
    RunResult result;
    EXPECT_EQ(best_gain(loss, result), nullptr);
    result.gains = {{"c=1", 100, 1}, {"a=2", 100, 97}, {"b=4", 100, 90}};
    EXPECT_EQ(best_gain(loss, result), &result.gains[2]);
    result.gains[2].cycles_after = 98;
    EXPECT_EQ(best_gain(loss, result), &result.gains[1]);
}

TEST(Losses, SayWhatTheChangeGains) {
    RunResult result = waiting_for_pixels(1, 1, 65);
    const std::string loss = "after the last task 50.0 % of the frame ";
    const std::string change = losses_of(result).front().keys.front().change;
    EXPECT_EQ(named_changes(result), std::vector<std::string>{change});
    EXPECT_EQ(losses_line(result), loss + "(raise pixel_buffer.readout_pixels)");
    result.gains = {{change, 100, 96.9}};
    EXPECT_EQ(losses_line(result), loss + "(" + change + " gains 3.1 %)");
    result.gains = {{change, 100, 104}};
    EXPECT_EQ(losses_line(result), loss + "(" + change + " gains nothing)");
}

} // namespace
} // namespace degs::sim_test
