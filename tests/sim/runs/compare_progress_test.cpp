// SPDX-License-Identifier: Apache-2.0
// How a comparison goes on: what it says meanwhile, how many runs it makes at a time, how it stops.
#include <algorithm>
#include <csignal>
#include <set>

#include "sim/process/stopwatch.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

const char* const kSmallScene = "synthetic:object,gaussians=300";

std::vector<std::string> small_comparison(const std::string& out,
                                          const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "compare", config("degs-64"), config("gscore-64"), "--width", "64", "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::vector<std::string> lines_in(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

TEST(CompareProgress, CountsFinishedRunsWhereThereIsNoTerminal) {
    const Folder folder;
    const std::vector<std::string> lines =
        lines_in(degs(small_comparison(folder / "c", {"--scene", kSmallScene, "--camera", "0,1",
                                                      "--frames", "2"}))
                     .err);
    ASSERT_EQ(lines.size(), 8U); // two designs, two views, alone and as a path
    for (std::size_t i = 0; i < lines.size(); ++i) {
        EXPECT_EQ(lines[i].rfind(std::to_string(i + 1) + " of 8 runs done · ", 0), 0U) << lines[i];
    }
    EXPECT_NE(lines[1].find("object · camera 0 · 64×48, 2 frames · "), std::string::npos);
}

TEST(CompareProgress, KnowsTheTotalOfAllCamerasWhenScenesAreLoaded) {
    const Folder folder;
    const std::vector<std::string> lines =
        lines_in(degs(small_comparison(folder / "c", {"--scene", kSmallScene, "--scene",
                                                      "synthetic:single", "--camera", "all"}))
                     .err);
    ASSERT_GE(lines.size(), 6U);
    EXPECT_EQ(lines.front().rfind("1 of at least 6 runs done", 0), 0U) << lines.front();
    const std::string all = std::to_string(lines.size());
    EXPECT_EQ(lines.back().rfind(all + " of " + all + " runs done", 0), 0U) << lines.back();
}

TEST(CompareProgress, TakesBackRunsThatAreNotPossible) {
    const Folder folder;
    std::ofstream(folder / "broken.ply") << "ply\n";
    write_camera(folder / "cameras.json", {0, 0, -3});
    const std::vector<std::string> lines =
        lines_in(degs(small_comparison(folder / "c", {"--scene", folder / "broken.ply", "--scene",
                                                      kSmallScene, "--camera", "0"}))
                     .err);
    ASSERT_EQ(lines.size(), 3U); // the last one is the failure
    EXPECT_EQ(lines[1].rfind("2 of 2 runs done", 0), 0U) << lines[1];
}

pid_t start_quietly(const std::vector<std::string>& arguments, const std::string& messages) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
        ::dup2(::open(messages.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
        std::vector<char*> argv{const_cast<char*>(DEGS_PROGRAM)};
        for (const std::string& argument : arguments) {
            argv.push_back(const_cast<char*>(argument.c_str()));
        }
        argv.push_back(nullptr);
        ::execv(DEGS_PROGRAM, argv.data());
        ::_exit(127);
    }
    return child;
}

std::set<pid_t> children_of(pid_t parent) {
    std::set<pid_t> children;
    for (const auto& entry : fs::directory_iterator("/proc")) {
        const std::string stat = read_file(entry.path() / "stat"); // pid (name) state parent ...
        const std::size_t name_end = stat.rfind(')');
        if (name_end != std::string::npos && std::atoi(&stat[name_end + 4]) == parent) {
            children.insert(std::atoi(stat.c_str()));
        }
    }
    return children;
}

/// Waits until `condition` holds; false after a minute.
bool wait_until(const std::function<bool()>& condition) {
    const sim::Stopwatch clock;
    while (!condition()) {
        if (clock.seconds() > 60) {
            return false;
        }
        ::usleep(2000);
    }
    return true;
}

// Four designs that share no frames. The first child that is seen is stopped, so that time plays no
// part: a second one must come while the first cannot end.
TEST(CompareJobs, DesignsWithFramesOfTheirOwnRunAtOnce) {
    const Folder folder;
    const pid_t program =
        start_quietly({"compare", config("degs-64"), config("gscore-64"), config("gbu-64"),
                       config("gcc-64"), "--scene", "synthetic:object,gaussians=20000",
                       "--no-reference", "--jobs", "2", "--out", folder / "c"},
                      folder / "err");
    pid_t first = 0;
    ASSERT_TRUE(wait_until([&] {
        const std::set<pid_t> children = children_of(program);
        first = children.empty() ? 0 : *children.begin();
        return first != 0 && ::kill(first, SIGSTOP) == 0;
    }));
    const bool two = wait_until([&] {
        const std::set<pid_t> children = children_of(program);
        EXPECT_LE(children.size(), 2U);
        return children.size() == 2 && children.count(first) == 1;
    });
    EXPECT_TRUE(two);
    ::kill(first, SIGCONT);
    int status = 0;
    ::waitpid(program, &status, 0);
    EXPECT_EQ(status, 0) << read_file(folder / "err");
    EXPECT_EQ(lines_in(read_file(folder / "err")).size(), 4U);
}

TEST(CompareNames, MayBeLong) {
    const Folder folder;
    const std::string name(300, 'n');
    write_ply(folder / (std::string(200, 's') + ".ply"), {Splat{}});
    const Outcome outcome =
        degs({"compare", name + "=" + config("degs-64"), name + "m=" + config("degs-64"), "--scene",
              folder / (std::string(200, 's') + ".ply"), "--width", "32", "--out", folder / "c"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const auto written = nlohmann::json::parse(read_file(folder / "c/compare.json"));
    EXPECT_EQ(written["configs"][1]["name"], name + "m");
    std::size_t reports = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "c/reports")) {
        reports += entry.is_regular_file() ? 1 : 0;
    }
    EXPECT_EQ(reports, 2U);
}

TEST(CompareCameras, ComeFromTheFileThatIsNamed) {
    const Folder folder;
    write_camera(folder / "views.json", {0, 0, -3});
    const std::string views = folder / "views.json";
    for (const std::vector<std::string>& more :
         std::vector<std::vector<std::string>>{{"--camera", "all"}, {"--cameras", "0"}}) {
        std::vector<std::string> options{"--scene", kSmallScene, "--camera-file", views};
        options.insert(options.end(), more.begin(), more.end());
        EXPECT_EQ(degs(small_comparison(folder / "c", options)).code, 0);
        const auto written = nlohmann::json::parse(read_file(folder / "c/compare.json"));
        ASSERT_EQ(written["views"].size(), 1U);
        EXPECT_EQ(written["views"][0]["height"], 48);
        EXPECT_EQ(written["views"][0]["img_name"], "camera 0");
    }
    // Options of degs run have the same names for the same things.
    const auto run = [&folder, &views](const char* option, const std::string& value) {
        return degs({"run", config("degs-64"), "--scene", kSmallScene, "--camera-file", views,
                     option, value, "--width", "32", "--out", folder / "r"});
    };
    for (const char* option : {"--camera", "--cameras"}) {
        expect_success(run(option, "0"));
        EXPECT_EQ(report_in(folder / "r")["camera"]["img_name"], "camera 0");
        expect_mistake(run(option, "0,1"), "'degs compare' takes several");
        expect_mistake(run(option, views), "--camera-file");
    }
    const Outcome file_as_positions =
        degs(small_comparison(folder / "c", {"--scene", kSmallScene, "--cameras", views}));
    expect_mistake(file_as_positions, "--camera-file");
}

/// Whether SIGINT would call something in the program.
bool catches_interrupts(pid_t program) {
    const std::string status = read_file("/proc/" + std::to_string(program) + "/status");
    const std::size_t at = status.find("SigCgt:");
    return at != std::string::npos &&
           (std::strtoull(&status[at + 7], nullptr, 16) >> (SIGINT - 1) & 1U) != 0;
}

TEST(Interruption, HasASentenceInEveryPhase) {
    const Folder folder;
    const std::vector<std::vector<std::string>> commands{
        {"render", "--scene", "synthetic:object,gaussians=20000000", "--out", folder / "a"},
        {"compare", config("degs-64"), "--scene", "synthetic:object,gaussians=20000000", "--out",
         folder / "b"}};
    for (const std::vector<std::string>& command : commands) {
        const std::string messages = folder / ("err-" + command.front());
        const pid_t program = start_quietly(command, messages);
        ASSERT_TRUE(wait_until([program] { return catches_interrupts(program); }));
        ::usleep(200000); // the scene is being made: a phase without a simulation
        ::kill(program, SIGINT);
        int status = 0;
        ::waitpid(program, &status, 0);
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT) << status;
        EXPECT_EQ(read_file(messages), "degs: Interrupted.\n");
    }
}

TEST(Interruption, IsIgnoredByThoseWhoWereStartedSo) {
    const Folder folder;
    const Outcome outcome =
        degs({"render", "--scene", "synthetic:single", "--width", "64", "--out", folder / "a"}, [] {
            std::signal(SIGINT, SIG_IGN);
            ::kill(::getpid(), SIGINT);
        });
    expect_success(outcome);
}

} // namespace
} // namespace degs::sim_test
