// SPDX-License-Identifier: Apache-2.0
// degs config --stats: what it lists is what runs report.
#include <set>
#include <sstream>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

std::vector<std::string> output_lines(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        lines.push_back(line);
    }
    return lines;
}

/// Paths of the numbers and texts that `degs config` lists with these arguments.
std::set<std::string> listed_by(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "config");
    arguments.insert(arguments.end(), {"--stats", "--format", "markdown"});
    const Outcome outcome = degs(arguments);
    expect_success(outcome);
    std::set<std::string> paths;
    for (const std::string& line : output_lines(outcome.out)) {
        if (line.rfind("| `", 0) == 0) {
            paths.insert(line.substr(3, line.find('`', 3) - 3));
        }
    }
    return paths;
}

std::set<std::string> listed(const std::string& config) {
    return listed_by({config});
}

/// A section that a design does not have is null: then one of its statistics is listed.
bool is_section(const std::string& path, const std::set<std::string>& list) {
    const auto first = list.lower_bound(path + ".");
    return first != list.end() && first->rfind(path + ".", 0) == 0;
}

/// "stages.*.busy" stands for "stages.span.busy".
bool is_listed(const std::string& path, const std::set<std::string>& list) {
    if (list.count(path) != 0) {
        return true;
    }
    for (std::size_t at = path.find('.'); at != std::string::npos;) {
        const std::size_t end = path.find('.', at + 1);
        if (end != std::string::npos &&
            list.count(path.substr(0, at) + ".*" + path.substr(end)) != 0) {
            return true;
        }
        at = end;
    }
    return false;
}

void collect_paths(const json& value, const std::string& path, std::vector<std::string>& paths) {
    if (!value.is_object()) {
        paths.push_back(path);
        return;
    }
    for (const auto& [key, child] : value.items()) {
        collect_paths(child, path.empty() ? key : path + "." + key, paths);
    }
}

class StatisticsOf : public ::testing::TestWithParam<const char*> {};

TEST_P(StatisticsOf, AReportAreListed) {
    const std::set<std::string> list = listed(config(GetParam()));
    EXPECT_GT(list.size(), 100U);
    for (const char* memory : {"bus", "lpddr5"}) {
        const Folder folder;
        expect_success(degs({"run", config(GetParam()), "--scene", "synthetic:object,gaussians=300",
                             "--width", "64", "--no-reference", "--out", folder / ".", "--set",
                             std::string("memory.model=") + memory}));
        json report = report_in(folder / ".");
        for (const char* other : {"schema", "tool", "scene", "camera", "config", "losses", "gains",
                                  "conservation", "warnings"}) {
            report.erase(other);
        }
        if (report["dram"]["energy_nj"].is_null()) {
            EXPECT_TRUE(is_section("dram.energy_nj", list));
            report["dram"].erase("energy_nj");
        }
        std::vector<std::string> paths;
        collect_paths(report, "", paths);
        EXPECT_GT(paths.size(), 100U);
        for (const std::string& path : paths) {
            EXPECT_TRUE(is_listed(path, list)) << path << " with " << memory;
        }
    }
}

TEST_P(StatisticsOf, DesignsHaveSentencesAndFitATerminal) {
    const Outcome outcome = degs({"config", config(GetParam()), "--stats"});
    expect_success(outcome);
    const std::vector<std::string> lines = output_lines(outcome.out);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        EXPECT_LE(lines[i].size(), 80U) << lines[i];
        if (lines[i].find(" [") != std::string::npos && lines[i].front() != ' ') {
            ASSERT_LT(i + 1, lines.size());
            EXPECT_EQ(lines[i + 1].rfind("    ", 0), 0U) << lines[i] << " has no sentence";
        }
    }
}

TEST_P(StatisticsOf, StreamsHaveSentences) {
    const Outcome outcome =
        degs({"config", config(GetParam()), "--stats", "--section", "dram.streams"});
    expect_success(outcome);
    int streams = 0;
    for (const std::string& line : output_lines(outcome.out)) {
        if (line.rfind("dram.streams.", 0) == 0 && line.find('*') == std::string::npos) {
            EXPECT_NE(line.find(": "), std::string::npos) << line << " has no sentence";
            ++streams;
        }
    }
    EXPECT_GE(streams, 6);
}

INSTANTIATE_TEST_SUITE_P(Designs, StatisticsOf,
                         ::testing::Values("degs-64-tuned", "gscore-64", "gbu-64", "gcc-64"));

/// `paths` without doubles, as a set that can be compared with a list.
std::set<std::string> collected(const json& value) {
    std::vector<std::string> paths;
    collect_paths(value, "", paths);
    return {paths.begin(), paths.end()};
}

TEST(StatisticsOfMemory, AreThoseOfItsReport) {
    const Folder folder;
    expect_success(degs({"memory", config("memory/lpddr5-3200x128"), "--pattern", "strided",
                         "--requests", "1000", "--out", folder / "."}));
    json report = json::parse(read_file(folder / "memory.json"));
    for (const char* other : {"schema", "tool", "config"}) {
        report.erase(other);
    }
    json each; // entry of the curve
    each["*"] = report["curve"].at(0);
    report["curve"] = each;
    // A trace that is replayed in place of a pattern has statistics of its own.
    std::ofstream(folder / "one.stl") << "5: (32) read 0x40\n";
    expect_success(degs({"memory", config("memory/lpddr5-3200x128"), "--trace", folder / "one.stl",
                         "--out", folder / "trace"}));
    const json replayed = json::parse(read_file(folder / "trace/memory.json"));
    report["traffic"].update(replayed["traffic"]);
    EXPECT_EQ(collected(report), listed_by({"--of", "memory"}));
}

TEST(StatisticsOfMemory, HaveSentences) {
    const Outcome outcome = degs({"config", "--stats", "--of", "memory"});
    expect_success(outcome);
    EXPECT_NE(outcome.out.find("\ncommands.ref_ab [commands]\n    REFab: "), std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("\naccesses: Accesses of up to 64 B"), std::string::npos);
}

TEST(StatisticsOfCompare, AreTheKeysOfARun) {
    const Folder folder;
    const Outcome outcome =
        degs({"compare", config("degs-16"), "--scene", "synthetic:object,gaussians=100", "--width",
              "64", "--out", folder / "."});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    json run = json::parse(read_file(folder / "compare.json"))["runs"].at(0);
    for (const char* other : {"config", "view", "fidelity"}) {
        run.erase(other);
    }
    for (json* parts : {&run["buffers"], &run["energy"]["blocks"]}) {
        json any;
        any["*"] = parts->begin().value();
        *parts = any;
    }
    EXPECT_EQ(collected(run), listed_by({"--of", "compare"}));
}

TEST(StatisticsCommand, ShowsASectionOfAnAccelerator) {
    const Outcome outcome = degs(
        {"config", "--stats", "gscore", "--section", "stages.blending", "--format", "markdown"});
    expect_success(outcome);
    EXPECT_NE(outcome.out.find("| `passes` | passes | "), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("busy"), std::string::npos) << "every stage has it";
    const Outcome whole = degs({"config", "--stats"});
    expect_success(whole);
    EXPECT_NE(whole.out.find("\nstages.*.busy [share]\n"), std::string::npos) << whole.out;
    const Outcome keys = degs({"config", "gbu"});
    expect_success(keys);
    EXPECT_EQ(keys.out.rfind("accelerator = gbu\n", 0), 0U);
}

// Not under the address sanitizer, which cannot follow an exception after SystemC's threads have
// run (github.com/google/sanitizers/issues/189): the list comes from a run of one empty tile.
TEST(UnknownStatistics, AreMistakes) {
    expect_mistake(degs({"config", "--stats", "--section", "stages.spam"}),
                   "did you mean 'stages.span'?");
    expect_mistake(degs({"config", "--stats", "--section", std::string(5000, 'x')}), "xxx");
}

TEST(HostileStatistics, Mistakes) {
    expect_mistake(degs({"config", "--stats", "--format", "yaml"}), "yaml");
    expect_mistake(degs({"config", "--section", "stages"}), "--stats");
    expect_mistake(degs({"config", "gpu", "--stats"}), "gpu");
    expect_mistake(degs({"config", "--stats", "--of", "soc"}), "soc");
    expect_mistake(degs({"config", "--of", "memory"}), "--stats");
    expect_mistake(
        degs({"config", "gbu", "--stats", "--of", "memory"}),
        "--of has the same statistics for every configuration, so it cannot be combined with "
        "CONFIG.");
}

} // namespace
} // namespace degs::sim_test
