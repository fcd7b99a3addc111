// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>

namespace degs::sim {

/// Measures host time since its construction.
class Stopwatch {
public:
    double seconds() const { return seconds_to(std::chrono::steady_clock::now()); }
    double seconds_to(std::chrono::steady_clock::time_point date) const {
        // The standard lets a steady clock never go back, but those of some virtual machines do.
        return std::max(0.0, std::chrono::duration<double>(date - start_).count());
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Measures the time that all threads of this process have computed since its construction, s: what
/// one processor would need.
class CpuStopwatch {
public:
    CpuStopwatch() : CpuStopwatch(CLOCK_PROCESS_CPUTIME_ID) {}
    /// What the thread that asks has computed.
    static CpuStopwatch of_this_thread() { return CpuStopwatch(CLOCK_THREAD_CPUTIME_ID); }
    double seconds() const { return std::max(0.0, now() - start_); }

private:
    explicit CpuStopwatch(clockid_t clock) : clock_(clock) {}
    double now() const {
        timespec time{};
        ::clock_gettime(clock_, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    clockid_t clock_;
    double start_ = now();
};

} // namespace degs::sim
