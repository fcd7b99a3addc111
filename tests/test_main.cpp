// SPDX-License-Identifier: Apache-2.0
// GoogleTest inside sc_main, a process for each test: SystemC elaborates once per process, and what
// one test leaves behind does not reach the next. The process is a fork of this one, which costs a
// millisecond where a program that starts anew takes 50. A test that is selected alone runs in this
// process, for a debugger. `--suites` prints the names that CTest gets (suites.cmake).
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <fnmatch.h>
#include <gtest/gtest.h>
#include <systemc>

#include "base/sanitizers.hpp"

namespace {
using testing::TestInfo;

/// SystemC prints its banner before sc_main; set early, it spares builds (test discovery) and
/// tests.
const int kNoBanner = ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
/// Tests neither find nor leave anything in the cache of whoever runs them.
const int kNoCache = ::setenv("DEGS_CACHE", "", 1);
/// What CTest takes for a test that was skipped.
constexpr int kSkipped = 77;

/// Whether one of the patterns between colons matches the name.
bool matches(const std::string& patterns, const std::string& name) {
    for (std::size_t begin = 0; begin <= patterns.size();) {
        const std::size_t end = std::min(patterns.find(':', begin), patterns.size());
        if (::fnmatch(patterns.substr(begin, end - begin).c_str(), name.c_str(), 0) == 0) {
            return true;
        }
        begin = end + 1;
    }
    return false;
}

bool selected(const TestInfo& test) {
    const std::string filter = GTEST_FLAG_GET(filter);
    const std::size_t minus = std::min(filter.find('-'), filter.size());
    const std::string wanted = minus == 0 ? "*" : filter.substr(0, minus);
    const std::string name = std::string(test.test_suite_name()) + "." + test.name();
    const bool disabled = matches("DISABLED_*:*/DISABLED_*", test.test_suite_name()) ||
                          matches("DISABLED_*", test.name());
    return matches(wanted, name) &&
           (minus == filter.size() || !matches(filter.substr(minus + 1), name)) &&
           (!disabled || GTEST_FLAG_GET(also_run_disabled_tests));
}

std::vector<const TestInfo*> selected_tests() {
    std::vector<const TestInfo*> tests;
    const testing::UnitTest& all = *testing::UnitTest::GetInstance();
    for (int i = 0; i < all.total_test_suite_count(); ++i) {
        const testing::TestSuite& suite = *all.GetTestSuite(i);
        for (int j = 0; j < suite.total_test_count(); ++j) {
            if (selected(*suite.GetTestInfo(j))) {
                tests.push_back(suite.GetTestInfo(j));
            }
        }
    }
    return tests;
}

/// A line per suite that has tests: its name, and how many.
int print_suites(const std::vector<const TestInfo*>& tests) {
    for (std::size_t begin = 0, end = 0; begin < tests.size(); begin = end) {
        const std::string suite = tests[begin]->test_suite_name();
        while (end < tests.size() && suite == tests[end]->test_suite_name()) {
            ++end;
        }
        std::printf("%s %zu\n", suite.c_str(), end - begin);
    }
    return 0;
}

/// Prints what went wrong, and nothing else: the parent prints names and times.
class Failures : public testing::EmptyTestEventListener {
public:
    bool skipped = false;

    void OnTestPartResult(const testing::TestPartResult& part) override {
        skipped = skipped || part.skipped();
        if (!part.passed()) {
            std::printf("%s:%d: %s\n", part.file_name() != nullptr ? part.file_name() : "unknown",
                        part.line_number(), part.message());
            std::fflush(stdout);
        }
    }
};

/// Runs a test in the process that was forked for it; the value that the process returns.
int run_here(const TestInfo& test) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    auto* const failures = new Failures;
    listeners.Append(failures);
    GTEST_FLAG_SET(filter, std::string(test.test_suite_name()) + "." + test.name());
    const int failed = RUN_ALL_TESTS();
    return failed == 0 && failures->skipped ? kSkipped : failed;
}

/// How a process ended, for the line behind its test.
std::string ending_of(int status) {
    if (WIFSIGNALED(status)) {
        return std::string("  FAILED  ] (") + ::strsignal(WTERMSIG(status)) + ")";
    }
    const int code = WEXITSTATUS(status);
    return code == 0 ? "       OK ]" : code == kSkipped ? "  SKIPPED ]" : "  FAILED  ]";
}

/// Runs each test in a process of its own, one after the other.
int run_each(const std::vector<const TestInfo*>& tests) {
    std::size_t skipped = 0;
    std::size_t failed = 0;
    for (const TestInfo* const test : tests) {
        std::printf("[ RUN      ] %s.%s\n", test->test_suite_name(), test->name());
        std::fflush(nullptr);
        const auto start = std::chrono::steady_clock::now();
        const pid_t child = ::fork();
        if (child == 0) {
            return run_here(*test);
        }
        int status = 0;
        if (child < 0 || ::waitpid(child, &status, 0) != child) {
            std::perror("no process for a test");
            return 1;
        }
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - start;
        std::printf("[%s %s.%s (%.0f ms)\n", ending_of(status).c_str(), test->test_suite_name(),
                    test->name(), took.count());
        skipped += WIFEXITED(status) && WEXITSTATUS(status) == kSkipped ? 1 : 0;
        failed += !WIFEXITED(status) || (WEXITSTATUS(status) % kSkipped != 0) ? 1 : 0;
        if (failed > 0 && GTEST_FLAG_GET(fail_fast)) {
            break;
        }
    }
    std::printf("%zu passed, %zu failed, %zu skipped\n", tests.size() - failed - skipped, failed,
                skipped);
    return failed > 0 || tests.empty() ? 1 : skipped == tests.size() ? kSkipped : 0;
}
} // namespace

#if DEGS_ADDRESS_SANITIZER
/// As in sim/main_function.cpp: the leak sanitizer cannot read the stacks of SystemC's threads.
extern "C" int __lsan_is_turned_off() { // NOLINT(bugprone-reserved-identifier)
    return sc_core::sc_start_of_simulation_invoked() ? 1 : 0;
}
#endif

int sc_main(int argc, char* argv[]) {
    ::testing::InitGoogleTest(&argc, argv);
    if (kNoBanner != 0 || kNoCache != 0) {
        return 1;
    }
    const std::vector<const TestInfo*> tests = selected_tests();
    if (argc == 2 && std::strcmp(argv[1], "--suites") == 0) {
        return print_suites(tests);
    }
    if (tests.size() != 1 && !GTEST_FLAG_GET(list_tests)) {
        return run_each(tests);
    }
    const int failed = RUN_ALL_TESTS();
    return failed == 0 && tests.size() == 1 && tests[0]->result()->Skipped() ? kSkipped : failed;
}
