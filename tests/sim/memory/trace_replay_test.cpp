// SPDX-License-Identifier: Apache-2.0
// degs run --memory-trace and degs memory --trace: a replay moves what the run moved, in its time.
#include <algorithm>
#include <map>
#include <sstream>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

const Words kTracedView{"--scene", "synthetic:object,gaussians=1000", "--width", "160"};

std::string narrow_memory() {
    return config("memory/lpddr5-3200x128");
}

/// The report of a run whose requests go to `trace`.
json run_traced(const std::string& design, const Words& view, const std::string& trace) {
    const Folder folder;
    Words arguments{"run",   config(design), "--memory",       narrow_memory(),
                    "--out", folder / "out", "--no-reference", "--memory-trace",
                    trace};
    arguments.insert(arguments.end(), view.begin(), view.end());
    expect_success(degs(arguments));
    return report_in(folder / "out");
}

json replay(const std::string& trace, const Words& more = {}) {
    const Folder folder;
    Words arguments{"memory", narrow_memory(), "--trace", trace, "--out", folder / "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = degs(arguments);
    expect_success(outcome);
    EXPECT_NE(outcome.out.find("trace · "), std::string::npos) << outcome.out;
    return json::parse(read_file(folder / "out/memory.json"));
}

/// ns that the run counts its memory over, at 1 GHz.
double memory_ns(const json& report) {
    return report["dram"]["window_cycles"].get<double>();
}

std::uint64_t bytes_moved(const json& report) {
    return report["dram"]["bytes_read"].get<std::uint64_t>() +
           report["dram"]["bytes_written"].get<std::uint64_t>();
}

class SmallRunMemoryTrace : public testing::TestWithParam<std::string> {};

TEST_P(SmallRunMemoryTrace, ReplaysWhatTheRunMovedInItsTime) {
    const Folder folder;
    const json report = run_traced(GetParam(), kTracedView, folder / "run.stl");
    const json replayed = replay(folder / "run.stl");
    EXPECT_EQ(replayed["bytes"], bytes_moved(report));
    const double ns = 1000 * replayed["simulated_us"].get<double>();
    EXPECT_NEAR(ns / memory_ns(report), 1.0, 0.02);
    EXPECT_NEAR(replayed["access_hit_rate"].get<double>(),
                report["dram"]["row_hit_rate"].get<double>(), 0.01);
    EXPECT_TRUE(replayed["traffic"]["dated"].get<bool>());
}
INSTANTIATE_TEST_SUITE_P(All, SmallRunMemoryTrace,
                         testing::Values("degs-64", "gscore-64", "gbu-64", "gcc-64", "orange-o1"),
                         [](const auto& design) {
                             std::string name = design.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

// The bytes of every stream are in the trace, and dates do not fall.
TEST(SmallRunMemoryTraceFile, HoldsEveryStreamInTheOrderOfDates) {
    const Folder folder;
    const json report = run_traced("degs-64", kTracedView, folder / "run.stl");
    std::istringstream lines(read_file(folder / "run.stl"));
    std::string line, first, second;
    std::getline(lines, first);
    std::getline(lines, second);
    EXPECT_EQ(first + second, "# degs-64# clock_ghz 1");
    std::uint64_t before = 0, frame_buffer = 0;
    std::map<std::string, std::uint64_t> lines_of;
    while (std::getline(lines, line)) {
        std::istringstream words(line);
        std::uint64_t cycle = 0, bytes = 0;
        char colon = 0, left = 0, right = 0, hash = 0;
        std::string command, address, stream;
        words >> cycle >> colon >> left >> bytes >> right >> command >> address >> hash >> stream;
        ASSERT_TRUE(words && words.eof()) << line;
        EXPECT_GE(cycle, before) << line;
        EXPECT_TRUE(command == "read" || command == "write") << line;
        EXPECT_LE(std::stoull(address, nullptr, 16) % 64 + bytes, 64U) << line;
        before = cycle;
        ++lines_of[stream];
        frame_buffer += stream == "frame_buffer" ? bytes : 0;
    }
    EXPECT_EQ(frame_buffer, 160U * 120 * 4);
    for (const auto& [stream, use] : report["dram"]["streams"].items()) {
        EXPECT_GT(lines_of[stream], 0U) << stream;
    }
    EXPECT_EQ(lines_of.size(), report["dram"]["streams"].size());
}

// Without dates a request does not wait for the accelerator, but for the memory alone.
TEST(SmallRunMemoryTraceFile, ReplaysLoadsAndStoresAsFastAsTheMemoryTakesThem) {
    const Folder folder;
    const json report = run_traced("degs-64", kTracedView, folder / "run.ldst");
    const json replayed = replay(folder / "run.ldst");
    EXPECT_FALSE(replayed["traffic"]["dated"].get<bool>());
    const double ns = 1000 * replayed["simulated_us"].get<double>();
    EXPECT_LT(ns, memory_ns(report));
    EXPECT_GT(ns, replayed["bytes"].get<double>() / replayed["peak_gb_per_s"].get<double>());
    EXPECT_GT(replayed["bandwidth_fraction"].get<double>(), 0.8);
    EXPECT_GE(replayed["bytes"], bytes_moved(report)) << "lines are moved whole";
    const std::string text = read_file(folder / "run.ldst");
    const auto lines = static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n'));
    EXPECT_EQ(replayed["traffic"]["requests"], lines);
}

// A run does not depend on whether it is recorded.
TEST(SmallRunMemoryTraceFile, ChangesNothing) {
    const Folder folder;
    json traced = run_traced("degs-64", kTracedView, folder / "run.stl");
    Words arguments{"run",   config("degs-64"), "--memory",      narrow_memory(),
                    "--out", folder / "out",    "--no-reference"};
    arguments.insert(arguments.end(), kTracedView.begin(), kTracedView.end());
    expect_success(degs(arguments));
    json plain = report_in(folder / "out");
    traced.erase("host");
    plain.erase("host");
    EXPECT_EQ(traced, plain);
}

// 96 bytes from the middle of a line are accesses of two lines, and 100 cycles of a clock of
// 2 GHz are 50 ns.
TEST(SmallRunReplay, FollowsTheDatesOfAForeignTrace) {
    const Folder folder;
    std::ofstream(folder / "own.stl") << "# a comment\n\n10: (96) read 0x20\n"
                                         "110:\twrite\t40 0x0123 \r\n";
    const json replayed = replay(folder / "own.stl", {"--trace-ghz", "2"});
    EXPECT_EQ(replayed["traffic"]["reads"], 2);
    EXPECT_EQ(replayed["traffic"]["writes"], 1);
    EXPECT_EQ(replayed["traffic"]["bytes_read"], 96);
    EXPECT_EQ(replayed["bytes"], 160);
    EXPECT_GT(replayed["simulated_us"].get<double>(), 0.050);
    EXPECT_LT(replayed["simulated_us"].get<double>(), 0.060);
}

// A memory stands by for 200 us before the first request; neither its time nor its energy nor its
// refreshes are those of the trace.
TEST(SmallRunReplay, CountsFromTheFirstRequest) {
    const Folder folder;
    std::ofstream(folder / "late.stl") << "200000: read 0x0\n200010: read 0x40\n";
    const json replayed = replay(folder / "late.stl");
    const double us = replayed["simulated_us"].get<double>();
    EXPECT_LT(us, 0.5);
    const json& memory = replayed["config"];
    const double channels = memory["channels"].get<double>(); // 1 mW for 1 us is 1 nJ
    const double background = replayed["energy"]["background_nj"].get<double>();
    EXPECT_GE(background, channels * us * memory["energy"]["standby_closed_mw"].get<double>());
    EXPECT_LE(background, channels * us * memory["energy"]["standby_open_mw"].get<double>());
    EXPECT_LE(replayed["energy"]["refresh_nj"].get<double>(),
              channels * memory["energy"]["refresh_all_bank_nj"].get<double>());
}

// The case of docs/memory.md, in which memory limits the frame.
TEST(LongMemoryTrace, TakesTheTimeOfAFrameThatMemoryLimits) {
    const fs::path scene = trained_scenes() / "flowers" / "scene.ply";
    if (!fs::exists(scene)) {
        GTEST_SKIP() << "the trained scene flowers is not in " << trained_scenes();
    }
    const Folder folder;
    const json report =
        run_traced("degs-256", {"--scene", scene.string(), "--camera", "2"}, folder / "run.stl");
    EXPECT_GT(report["dram"]["utilization"].get<double>(), 0.8);
    const json replayed = replay(folder / "run.stl");
    EXPECT_EQ(replayed["bytes"], bytes_moved(report));
    EXPECT_NEAR(1000 * replayed["simulated_us"].get<double>() / memory_ns(report), 1.0, 0.02);
}

struct Broken {
    const char* name;
    const char* text;
    const char* sentence;
};
std::ostream& operator<<(std::ostream& out, const Broken& broken) {
    return out << broken.name;
}

class HostileTrace : public testing::TestWithParam<Broken> {};

TEST_P(HostileTrace, IsRefusedWithItsLine) {
    const Folder folder;
    const std::string file = folder / "bad.stl";
    std::ofstream(file, std::ios::binary) << GetParam().text;
    const Outcome outcome =
        degs({"memory", narrow_memory(), "--trace", file, "--out", folder / "out"});
    expect_mistake(outcome, file + ": " + GetParam().sentence);
    EXPECT_FALSE(fs::exists(folder / "out/memory.json"));
}
INSTANTIATE_TEST_SUITE_P(
    All, HostileTrace,
    testing::Values(
        Broken{"empty", "", "the file is empty"},
        Broken{"comments", "# nothing\n\n", "the trace holds no request"},
        Broken{"word", "LD 0x40\nLOAD 0x40\n", "line 2: the line has another form"},
        Broken{"first_word", "LOAD 0x40\n", "line 1: a line begins with LD, ST or a cycle"},
        Broken{"mixed", "1: read 0x40\nST 0x40\n", "line 2: the line has another form"},
        Broken{"no_address", "LD\n", "line 1: the address '' is not a number"},
        Broken{"hexadecimal", "LD 0xzz\n", "line 1: the address '0xzz' is not a number"},
        Broken{"no_prefix", "LD ff\n", "line 1: the address 'ff' is not a number"},
        Broken{"sign", "ST -64\n", "line 1: the address '-64' is not a number"},
        Broken{"third_word", "LD 0x40 0x80\n", "line 1: LD or ST and an address stand on a line"},
        Broken{"far", "LD 0x0\nLD 0xffffffffffffffff\n", "line 2: the request of 64 bytes at"},
        Broken{"overflow", "LD 0x1ffffffffffffffff\n", "line 1: the address '0x1ffffffffffffffff'"},
        Broken{"past_the_end", "0: (1048576) read 0x1ffffffc0\n", "line 1: the request of 1048576"},
        Broken{"cycle", "x: read 0x0\n", "line 1: a line begins with LD, ST or a cycle"},
        Broken{"no_colon", "7 read 0x0\n", "line 1: a line begins with LD, ST or a cycle"},
        Broken{"colon", ": read 0x0\n", "line 1: a line begins with LD, ST or a cycle"},
        Broken{"late", "99999999999999: read 0x0\n", "line 1: the cycle 99999999999999 is later"},
        Broken{"backwards", "7: read 0x0\n6: read 0x0\n", "line 2: the cycle 6 is before 7"},
        Broken{"command", "7: fetch 0x0\n", "line 1: the command must be read or write"},
        Broken{"nothing", "7:\n", "line 1: the command must be read or write, not ''"},
        Broken{"zero_bytes", "7: (0) read 0x0\n", "line 1: the bytes must be a number from 1"},
        Broken{"no_bytes", "7: () read 0x0\n", "line 1: the bytes must be a number from 1"},
        Broken{"open_bytes", "7: ( read 0x0\n", "line 1: the bytes must be a number from 1"},
        Broken{"bare_bytes", "7: (64 read 0x0\n", "line 1: the bytes must be a number from 1"},
        Broken{"many_bytes", "7: (1048577) read 0x0\n", "line 1: the bytes must be a number"},
        Broken{"no_hexadecimal", "7: read 0x\n", "line 1: the address '0x' is not a hexadecimal"},
        Broken{"clock", "# clock_ghz 0\n1: read 0x0\n", "line 1: the clock must be a number of"},
        Broken{"clock_word", "# clock_ghz nan\n1: read 0x0\n", "line 1: the clock must be a"},
        Broken{"binary", "\x01\x02\xff\n",
               "line 1: a line begins with LD, ST or a cycle and a "
               "colon, such as '12:', not with '"}),
    [](const auto& broken) { return std::string(broken.param.name); });

TEST(HostileTraceFile, OfOneEndlessLineIsRefused) {
    const Folder folder;
    std::ofstream(folder / "bad.stl") << std::string(1000000, '#');
    expect_mistake(
        degs({"memory", narrow_memory(), "--trace", folder / "bad.stl", "--out", folder / "out"}),
        "bad.stl: line 1: the line is longer than 4096 characters");
}

class HostileTraceOption : public testing::TestWithParam<std::pair<Words, std::string>> {};

TEST_P(HostileTraceOption, IsRefusedInASentence) {
    const Folder folder;
    std::ofstream(folder / "good.ldst") << "LD 0x40\n";
    Words arguments = GetParam().first;
    for (std::string& word : arguments) {
        word = word == "GOOD" ? folder / "good.ldst" : word == "NEW" ? folder / "new" : word;
    }
    arguments.insert(arguments.end(), {"--out", folder / "out"});
    const Outcome outcome = degs(arguments);
    expect_mistake(outcome, GetParam().second);
    EXPECT_FALSE(fs::exists(folder / "new"));
}
const std::string kFewGaussians = "synthetic:object,gaussians=100";
INSTANTIATE_TEST_SUITE_P(
    All, HostileTraceOption,
    testing::Values(
        std::pair{Words{"memory", narrow_memory(), "--trace", "none.stl"}, "there is no such file"},
        std::pair{Words{"memory", narrow_memory(), "--trace", "GOOD", "--seed", "2"}, "--seed"},
        std::pair{Words{"memory", narrow_memory(), "--trace", "GOOD", "--trace-ghz", "2"},
                  "has no cycles"},
        std::pair{Words{"memory", narrow_memory(), "--trace-ghz", "2"}, "--trace"},
        std::pair{
            Words{"run", config("degs-64"), "--scene", kFewGaussians, "--memory-trace", "NEW"},
            "must end in .stl, the form of DRAMSys, or in .ldst"},
        std::pair{Words{"run", config("degs-64"), "--scene", kFewGaussians, "--memory-trace",
                        "/dev/null/a.stl"},
                  "/dev/null"},
        std::pair{Words{"run", config("degs-64"), "--scene", kFewGaussians, "--fidelity",
                        "analytic", "--memory-trace", "a.stl"},
                  "--memory-trace needs a simulation"},
        std::pair{Words{"run", config("degs-64"), "--scene", kFewGaussians, "--within", "1%",
                        "--memory-trace", "a.stl"},
                  "--memory-trace needs every tile"}));

} // namespace
} // namespace degs::sim_test
