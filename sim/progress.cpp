// SPDX-License-Identifier: Apache-2.0
#include "sim/progress.hpp"

#include <chrono>
#include <iostream>
#include <utility>

#include <unistd.h>

#include "sim/stopwatch.hpp"

namespace degs::sim {
namespace {

constexpr double kQuietSeconds = 2.0;
constexpr std::chrono::milliseconds kPeriod{250};

std::string whole_seconds(double seconds) {
    return std::to_string(static_cast<long>(seconds + 0.5)) + " s";
}

} // namespace

std::string progress_line(const std::string& step, double seconds, double share) {
    if (!(share > 0)) {
        return step + " · " + whole_seconds(seconds);
    }
    const double left = seconds * (1.0 / share - 1.0);
    return step + " " + std::to_string(static_cast<int>(share * 100)) + " % · " +
           whole_seconds(seconds) + ", about " + whole_seconds(left) + " to go";
}

Progress::Progress(std::string step) : step_(std::move(step)) {
    if (::isatty(STDERR_FILENO) != 0) {
        watcher_ = std::thread([this] { watch(); });
    }
}

Progress::~Progress() {
    if (watcher_.joinable()) {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            over_ = true;
        }
        wake_.notify_one();
        watcher_.join();
    }
}

void Progress::watch() {
    const char* const clear = "\r\x1b[K";
    const Stopwatch clock;
    bool shown = false;
    std::unique_lock<std::mutex> lock(mutex_);
    while (!wake_.wait_for(lock, kPeriod, [this] { return over_; })) {
        if (clock.seconds() > kQuietSeconds) {
            std::cerr << clear << progress_line(step_, clock.seconds(), share_) << std::flush;
            shown = true;
        }
    }
    if (shown) {
        std::cerr << clear << std::flush;
    }
}

} // namespace degs::sim
