// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "degs/error.hpp"

namespace degs::test {

/// What reading a file takes in a process of its own, whose peak of memory begins at what this one
/// has.
struct ReadingCost {
    bool ended = false; ///< without a signal
    long bytes = 0;     ///< grown
    double seconds =
        0; ///< of all processors together, which other programs on the machine hardly change
};

inline ReadingCost cost_so_far() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return {true, usage.ru_maxrss * 1024, seconds(usage.ru_utime) + seconds(usage.ru_stime)};
}

/// The cost of `read()`, which may accept the file or refuse it. Not for suites under the address
/// sanitizer, which keeps what has been freed.
template <class Read>
ReadingCost cost_of_reading(const Read& read) {
    ::malloc_trim(0); // what this process has freed must not be at hand for the child
    int ends[2] = {-1, -1};
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const ReadingCost before = cost_so_far();
        try {
            read();
        } catch (const InputError&) { // costs something, too
        }
        ReadingCost cost = cost_so_far();
        cost.bytes -= before.bytes;
        ::_exit(::write(ends[1], &cost, sizeof cost) == sizeof cost ? 0 : 1);
    }
    ::close(ends[1]);
    ReadingCost cost;
    if (::read(ends[0], &cost, sizeof cost) != sizeof cost) {
        cost.ended = false;
    }
    ::close(ends[0]);
    int status = -1;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    cost.ended = cost.ended && status == 0;
    return cost;
}

} // namespace degs::test
