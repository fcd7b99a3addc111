// SPDX-License-Identifier: Apache-2.0
// The files of a search or a sweep are of one command, whenever it is killed.
#include <csignal>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

std::string space_of_eight(const Folder& folder) {
    const std::string file = folder / "space.yaml";
    std::ofstream(file) << "study: space\ndesigns:\n  - include: " << config("degs-64")
                        << "\n    name: degs-64\naxes:\n  span.count: [2, 4, 8, 16]\n"
                           "  packing.bytes: [x1, x2]\n"
                           "scenes: synthetic:object,gaussians=300\nwidth: 64\n";
    return file;
}

/// Runs the program with its output thrown away, and kills it after a while.
void run_and_kill(const std::vector<std::string>& arguments, std::chrono::microseconds time) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
        ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
        std::vector<char*> argv{const_cast<char*>(DEGS_PROGRAM)};
        for (const std::string& argument : arguments) {
            argv.push_back(const_cast<char*>(argument.c_str()));
        }
        argv.push_back(nullptr);
        ::execv(DEGS_PROGRAM, argv.data());
        ::_exit(127);
    }
    ::usleep(static_cast<useconds_t>(time.count()));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
}

/// Kills `first` and `second` by turns, both of whose points are finished, at moments all over
/// their time, and calls `check` after each.
void kill_by_turns(const std::vector<std::string>& first, const std::vector<std::string>& second,
                   const std::function<void()>& check) {
    ASSERT_EQ(degs(first).code, 0);
    ASSERT_EQ(degs(second).code, 0);
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(degs(first).code, 0);
    const auto whole = std::chrono::duration_cast<std::chrono::microseconds>(
        std::chrono::steady_clock::now() - begin);
    constexpr int kMoments = 40;
    for (int moment = 0; moment < kMoments; ++moment) {
        run_and_kill(moment % 2 == 0 ? second : first, whole * (moment + 1) / kMoments);
        check();
    }
}

// The goals of the document are those of the table and of the picture, or there is no document.
TEST(LongWholeResults, OfASearchThatIsKilled) {
    const Folder folder;
    const std::string file = space_of_eight(folder);
    const std::string out = folder / "o";
    const auto with = [&](const std::string& goals) {
        return std::vector<std::string>{"explore", file,  "--budget", "5",
                                        "--goals", goals, "--out",    out};
    };
    kill_by_turns(with("area_mm2,latency_ms"), with("area_mm2,energy.nj_per_frame"), [&] {
        if (fs::exists(out + "/explore.json")) {
            const auto found = nlohmann::json::parse(read_file(out + "/explore.json"));
            const std::string goal = found["goals"][1].get<std::string>();
            const std::string table = read_file(out + "/front.csv");
            EXPECT_NE(table.substr(0, table.find('\n')).find("area_mm2," + goal + ","),
                      std::string::npos)
                << table;
            EXPECT_NE(read_file(out + "/front.svg").find(">" + goal + " ("), std::string::npos);
        }
    });
}

TEST(LongWholeResults, OfASweepThatIsKilled) {
    const Folder folder;
    const std::string file = space_of_eight(folder);
    const std::string out = folder / "o";
    const std::vector<std::string> all{"sweep", file, "--out", out};
    const std::vector<std::string> two{"sweep",    file,  "--set", "memory.latency_ns=50",
                                       "--camera", "0,1", "--out", out};
    kill_by_turns(all, two, [&] {
        if (fs::exists(out + "/results.json")) {
            const auto found = nlohmann::json::parse(read_file(out + "/results.json"));
            const std::string csv = read_file(out + "/results.csv");
            EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), found["runs"].size() + 1);
            const std::string host = read_file(out + "/host.csv");
            EXPECT_EQ(std::count(host.begin(), host.end(), '\n'), found["runs"].size() + 1);
        }
    });
}

} // namespace
} // namespace degs::sim_test
