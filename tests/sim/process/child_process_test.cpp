// SPDX-License-Identifier: Apache-2.0
#include "sim/process/child_process.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <map>
#include <new>
#include <stdexcept>

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/parallel.hpp"
#include "degs/error.hpp"
#include "sim/process/stopping_signals.hpp"
#include "sim/process/stopwatch.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim {
namespace {

using sim_test::Folder;
using sim_test::fs::exists;

struct Children {
    bool complete = false;
    std::map<std::size_t, ChildOutcome> outcomes;
    std::vector<std::size_t> order;
};

Children run_children(const std::vector<ChildJob>& jobs, int at_once = 1) {
    Children result;
    ChildWatcher watcher;
    watcher.ended = [&result](std::size_t job, ChildOutcome&& outcome) {
        EXPECT_TRUE(result.outcomes.emplace(job, std::move(outcome)).second);
        result.order.push_back(job);
    };
    result.complete = run_children(jobs, at_once, watcher);
    return result;
}

ChildOutcome run_one(const std::function<std::string()>& work) {
    Children result = run_children({{"job", work}});
    EXPECT_TRUE(result.complete);
    return std::move(result.outcomes.at(0));
}

/// The job failed with this code and sentence.
void expect_failure(const ChildOutcome& outcome, int code, const std::string& words) {
    ASSERT_TRUE(outcome.failure);
    EXPECT_EQ(outcome.failure->code, code);
    EXPECT_EQ(outcome.failure->sentence.rfind("job: ", 0), 0U) << outcome.failure->sentence;
    EXPECT_NE(outcome.failure->sentence.find(words), std::string::npos)
        << outcome.failure->sentence;
    EXPECT_EQ(outcome.failure->sentence.back(), '.');
    EXPECT_EQ(outcome.output, "");
}

TEST(ChildProcess, BringsBackWhatTheWorkReturns) {
    std::string large;
    for (int i = 0; i < 1000000; ++i) { // many times what a pipe holds
        large += static_cast<char>(i % 256);
    }
    for (const std::string& text : {std::string("text"), std::string(), large}) {
        const ChildOutcome outcome = run_one([&text] { return text; });
        EXPECT_FALSE(outcome.failure);
        EXPECT_TRUE(outcome.output == text) << text.size();
    }
}

TEST(ChildProcess, SharesTheProcessors) {
    const auto work = [] { return std::to_string(host_threads()); };
    for (const int at_once : {1, 2, 1000}) {
        const Children result = run_children({{"a", work}, {"b", work}}, at_once);
        for (const auto& [job, outcome] : result.outcomes) {
            EXPECT_EQ(outcome.output, std::to_string(std::max(host_threads() / at_once, 1)));
        }
    }
}

TEST(Failures, TheWorstIsThatOfTheProgram) {
    EXPECT_FALSE(worst_of({}, "points"));
    EXPECT_EQ(worst_of({{kUserError, "A."}}, "points")->sentence, "A.");
    const Failure worst = *worst_of({{kUserError, "A."}, {kInternalError, "B."}}, "points");
    EXPECT_EQ(worst.code, kInternalError);
    EXPECT_EQ(worst.sentence, "2 points failed, one of them with: B.");
}

TEST(ChildProcess, SharesMemoryButKeepsItsChangesToItself) {
    int value = 1;
    EXPECT_EQ(run_one([&value] { return std::to_string(++value); }).output, "2");
    EXPECT_EQ(value, 1);
}

TEST(ChildProcess, ExceptionsKeepTheirSentenceAndKind) {
    expect_failure(run_one([]() -> std::string { throw InputError("The scene is odd."); }),
                   kUserError, "The scene is odd.");
    expect_failure(run_one([]() -> std::string { throw std::logic_error("slots are missing"); }),
                   kInternalError, "Internal error: slots are missing.");
    expect_failure(run_one([]() -> std::string { throw std::bad_alloc(); }), kInternalError,
                   "not enough memory");
    expect_failure(run_one([]() -> std::string { throw 7; }), kInternalError, "unknown kind");
}

TEST(ChildProcess, SignalsAndEarlyEndsAreFailures) {
    const auto raised = [](int signal) {
        return run_one([signal]() -> std::string {
            std::signal(signal, SIG_DFL); // sanitizers have handlers of their own
            std::raise(signal);
            return "not reached";
        });
    };
    expect_failure(raised(SIGSEGV), kInternalError, "signal 11");
    expect_failure(raised(SIGKILL), kInternalError, "out of memory");
    expect_failure(run_one([]() -> std::string { ::_exit(3); }), kInternalError, "exit code 3");
    expect_failure(run_one([]() -> std::string { ::_exit(0); }), kInternalError, "exit code 0");
}

TEST(ChildProcess, OneFailureLeavesTheOthersAlone) {
    for (int at_once : {1, 2, 8}) {
        std::vector<ChildJob> jobs;
        for (int i = 0; i < 5; ++i) {
            jobs.push_back({"job " + std::to_string(i), [i]() -> std::string {
                                if (i == 2) {
                                    throw InputError("No.");
                                }
                                return std::to_string(i * i);
                            }});
        }
        const Children result = run_children(jobs, at_once);
        EXPECT_TRUE(result.complete);
        ASSERT_EQ(result.outcomes.size(), 5U);
        for (const auto& [job, outcome] : result.outcomes) {
            EXPECT_EQ(outcome.failure.has_value(), job == 2);
            EXPECT_EQ(outcome.output, job == 2 ? "" : std::to_string(job * job));
        }
        if (at_once == 1) {
            EXPECT_TRUE(std::is_sorted(result.order.begin(), result.order.end()));
        }
    }
    EXPECT_TRUE(run_children({}).complete);
}

TEST(ChildProcess, RunsAsManyAtOnceAsAllowed) {
    const auto nap = []() -> std::string {
        ::usleep(300000);
        return "";
    };
    const std::vector<ChildJob> jobs(6, ChildJob{"nap", nap});
    std::size_t most = 0;
    ChildWatcher watcher;
    watcher.ended = [](std::size_t, ChildOutcome&&) {};
    watcher.tick = [&most](std::size_t ended, const std::vector<std::size_t>& running) {
        EXPECT_LE(ended + running.size(), 6U);
        most = std::max(most, running.size());
    };
    EXPECT_TRUE(run_children(jobs, 3, watcher));
    EXPECT_EQ(most, 3U);
}

TEST(ChildPool, AJobMayLoseItsDataAsSoonAsItHasStarted) {
    std::map<std::size_t, std::string> outputs;
    ChildPool pool(2, {[&outputs](std::size_t job, ChildOutcome&& outcome) {
                           outputs[job] = std::move(outcome.output);
                       },
                       {}});
    for (int i = 0; i < 5; ++i) {
        std::string data = "data " + std::to_string(i);
        EXPECT_TRUE(pool.make_room());
        EXPECT_TRUE(pool.start({"job", [&data] {
                                    ::usleep(20000);
                                    return data;
                                }}));
        data = "gone";
    }
    EXPECT_TRUE(pool.finish());
    ASSERT_EQ(outputs.size(), 5U);
    EXPECT_EQ(outputs[0], "data 0");
    EXPECT_EQ(outputs[4], "data 4");
}

/// Written when static objects are destroyed, which happens in the parent alone.
struct AtExit {
    ~AtExit() { std::cout << "the parent's end\n"; }
};

TEST(ChildProcessDeathTest, DoesNotRunTheParentsExitOrBuffers) {
    const Folder folder;
    const pid_t program = ::fork(); // a parent of its own, whose output can be read
    if (program == 0) {
        if (std::freopen((folder / "out").c_str(), "w", stdout) == nullptr) {
            ::_exit(1);
        }
        static AtExit at_exit;
        std::cout << "buffered\n";
        std::printf("also buffered\n");
        run_one([] { return "x"; });
        run_one([]() -> std::string { throw InputError("x"); });
        std::exit(0);
    }
    int status = 0;
    ::waitpid(program, &status, 0);
    EXPECT_EQ(status, 0);
    std::string text = sim_test::read_file(folder / "out");
    for (const char* line : {"buffered\n", "also buffered\n", "the parent's end\n"}) {
        EXPECT_NE(text.find(line), std::string::npos) << line;
        EXPECT_EQ(text.find(line, text.find(line) + 1) != std::string::npos,
                  std::string(line) == "buffered\n") // it is in "also buffered", too
            << text;
    }
}

/// Starts a parent with two waiting children, does `act` to it, returns how it ended. The children
/// leave "late" in the folder if they live on when the parent has ended.
int end_of_parent(const Folder& folder, const std::function<void(pid_t)>& act) {
    const pid_t program = ::fork();
    if (program == 0) {
        const auto wait_and_tell = [&folder]() -> std::string {
            std::ofstream(folder / ("started" + std::to_string(::getpid())));
            const Stopwatch clock;
            while (!exists(folder / "ended") && clock.seconds() < 30) {
                ::usleep(10000);
            }
            std::ofstream(folder / "late");
            return "";
        };
        const Children result =
            run_children({{"a", [] { return ""; }}, {"b", wait_and_tell}, {"c", wait_and_tell}}, 2);
        ::_exit(!result.complete && result.outcomes.size() == 1 ? interruption_code() : 1);
    }
    const Stopwatch clock;
    const auto started = [&folder] {
        return std::distance(sim_test::fs::directory_iterator(folder / "."), {});
    };
    while (started() < 2 && clock.seconds() < 20) {
        ::usleep(10000);
    }
    act(program);
    int status = 0;
    ::waitpid(program, &status, 0);
    EXPECT_LT(clock.seconds(), 20);
    std::ofstream(folder / "ended");
    ::sleep(1);
    EXPECT_FALSE(exists(folder / "late"));
    return status;
}

TEST(ChildProcessDeathTest, SignalsToTheParentEndTheChildrenInOrder) {
    for (int signal : {SIGINT, SIGTERM}) {
        const Folder folder;
        const int status = end_of_parent(folder, [signal](pid_t pid) { ::kill(pid, signal); });
        EXPECT_TRUE(WIFEXITED(status));
        EXPECT_EQ(WEXITSTATUS(status), 128 + signal);
    }
}

TEST(ChildProcessDeathTest, AKilledParentTakesTheChildrenWithIt) {
    const Folder folder;
    const int status = end_of_parent(folder, [](pid_t pid) { ::kill(pid, SIGKILL); });
    EXPECT_TRUE(WIFSIGNALED(status));
}

} // namespace
} // namespace degs::sim
