// SPDX-License-Identifier: Apache-2.0
// degs explore --shard: several processes that make one search.
#include <chrono>
#include <csignal>
#include <future>
#include <set>
#include <thread>

#include "tests/sim/sweep/search_spaces.hpp"

namespace degs::sim_test {
namespace {

using Words = std::vector<std::string>;

Words search_words(const std::string& file, const std::string& out, const Words& more, int k = 0,
                   int n = 0) {
    Words all{"explore", file, "--out", out};
    all.insert(all.end(), more.begin(), more.end());
    if (n != 0) {
        all.insert(all.end(), {"--shard", std::to_string(k) + "/" + std::to_string(n)});
    }
    return all;
}

/// All parts at the same time.
std::vector<Outcome> explored_by(int parts, const std::string& file, const std::string& out,
                                 const Words& more) {
    std::vector<std::future<Outcome>> running;
    for (int k = 1; k <= parts; ++k) {
        running.push_back(std::async(std::launch::async, [=, &more] {
            return degs(search_words(file, out, more, k, parts));
        }));
    }
    std::vector<Outcome> outcomes;
    for (std::future<Outcome>& each : running) {
        outcomes.push_back(each.get());
    }
    return outcomes;
}

std::set<std::string> names_in(const std::string& folder) {
    std::set<std::string> files;
    for (const auto& file : fs::recursive_directory_iterator(folder)) {
        files.insert(fs::relative(file.path(), folder).string());
    }
    return files;
}

/// All files but those that tell of the machine that simulated: host.csv, points and reports.
void expect_same_folder(const std::string& whole, const std::string& parts) {
    EXPECT_EQ(names_in(whole), names_in(parts));
    int compared = 0;
    for (const std::string& file : names_in(whole)) {
        const bool of_host = file.find("host.csv") != std::string::npos ||
                             file.find("points/") != std::string::npos ||
                             file.find("reports/") != std::string::npos;
        if (fs::is_regular_file(fs::path(whole) / file) && !of_host) {
            ++compared;
            EXPECT_TRUE(read_file(fs::path(whole) / file) == read_file(fs::path(parts) / file))
                << file;
        }
    }
    EXPECT_GE(compared, 7);
}

TEST(LongSearchParts, AgreeWithOneProcess) {
    const Folder folder;
    const std::string file = two_view_space(folder);
    expect_same_folder(folder / "whole", [&] {
        EXPECT_EQ(degs(search_words(file, folder / "whole", kHalf)).code, 0);
        const std::vector<Outcome> two = explored_by(2, file, folder / "two", kHalf);
        EXPECT_EQ(two[0].code, 0) << two[0].err;
        EXPECT_NE(two[0].out.find("24 designs estimated"), std::string::npos) << two[0].out;
        EXPECT_EQ(two[1].code, 0) << two[1].err;
        EXPECT_EQ(two[1].out, "part 2 of 2 has ended; part 1 writes the results\n");
        // Each has run something.
        EXPECT_NE(two[0].err.find(" done · "), std::string::npos);
        EXPECT_NE(two[1].err.find(" done · "), std::string::npos);
        return folder / "two";
    }());
    for (const Outcome& outcome : explored_by(3, file, folder / "three", kHalf)) {
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    }
    expect_same_folder(folder / "whole", folder / "three");
}

// Without estimates nobody decides by what was not simulated by all.
TEST(LongSearchParts, AgreeWithoutEstimates) {
    const Folder folder;
    const std::string file = two_view_space(folder);
    const Words options{"--array-only", "--budget", "8"};
    EXPECT_EQ(degs(search_words(file, folder / "whole", options)).code, 0);
    for (const Outcome& outcome : explored_by(2, file, folder / "two", options)) {
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    }
    expect_same_folder(folder / "whole", folder / "two");
}

TEST(LongSearchParts, AgreeWhereDesignsFail) {
    const Folder folder;
    const std::string file = failing_space(folder);
    const Words options{"--budget", "5"};
    const Outcome whole = degs(search_words(file, folder / "whole", options));
    EXPECT_NE(whole.code, 0);
    for (const Outcome& outcome : explored_by(2, file, folder / "two", options)) {
        EXPECT_EQ(outcome.code, whole.code) << outcome.err;
    }
    expect_same_folder(folder / "whole", folder / "two");
}

/// A part in a process group of its own, without children that would go on.
pid_t started_part(const Words& arguments) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::setpgid(0, 0);
        std::vector<char*> argv{const_cast<char*>(DEGS_PROGRAM)};
        for (const std::string& word : arguments) {
            argv.push_back(const_cast<char*>(word.c_str()));
        }
        argv.push_back(nullptr);
        ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
        ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
        ::execv(DEGS_PROGRAM, argv.data());
        ::_exit(127);
    }
    return child;
}

TEST(LongSearchParts, AgreeWithOneProcessAfterOneWasKilled) {
    const Folder folder;
    const std::string file = two_view_space(folder);
    EXPECT_EQ(degs(search_words(file, folder / "whole", kHalf)).code, 0);
    const std::string out = folder / "two";
    const pid_t killed = started_part(search_words(file, out, kHalf, 2, 2));
    auto first =
        std::async(std::launch::async, [&] { return degs(search_words(file, out, kHalf, 1, 2)); });
    const auto made = [&out] { // simulated points
        std::error_code none;
        return std::distance(fs::directory_iterator(out + "/points", none),
                             fs::directory_iterator());
    };
    int status = 0;
    while (made() < 8 && ::waitpid(killed, &status, WNOHANG) == 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(-killed, SIGKILL);
    ::waitpid(killed, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "it was over before";
    EXPECT_EQ(first.wait_for(std::chrono::milliseconds(300)), std::future_status::timeout);
    const Outcome again = degs(search_words(file, out, kHalf, 2, 2));
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(again.out, "part 2 of 2 has ended; part 1 writes the results\n");
    const Outcome writer = first.get();
    EXPECT_EQ(writer.code, 0) << writer.err;
    EXPECT_NE(writer.out.find("24 designs estimated"), std::string::npos) << writer.out;
    expect_same_folder(folder / "whole", out);
}

TEST(SearchParts, NameThePartsThatAreMissing) {
    const Folder folder;
    const std::string file = two_view_space(folder);
    const auto waits = [&](const Words& more) {
        Words options = kHalf;
        options.insert(options.end(), {"--patience", "0.01"});
        Words all = search_words(file, folder / "out", options);
        all.insert(all.end(), more.begin(), more.end());
        return degs(all);
    };
    const Outcome outcome = waits({"--shard", "2/3"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("This is part 2 of 3, and has waited 0.01 minutes in vain for "
                               "parts 1, 3 ("),
              std::string::npos)
        << outcome.err;
    EXPECT_FALSE(fs::exists(folder / "out/explore.json"));
    expect_mistake(waits({}), "so it needs --shard.");
    expect_mistake(waits({"--shard", "3/2"}), "must be K/N");
    expect_mistake(waits({"--shard", "auto"}), "needs a task of a job array");
}

} // namespace
} // namespace degs::sim_test
