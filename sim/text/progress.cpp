// SPDX-License-Identifier: Apache-2.0
#include "sim/text/progress.hpp"

#include <chrono>
#include <iostream>
#include <utility>

#include <sys/ioctl.h>
#include <unistd.h>

#include "base/visible_text.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr double kQuietSeconds = 2.0;
constexpr std::chrono::milliseconds kPeriod{250};
constexpr const char* kClear = "\r\x1b[K";

bool silent = false;

std::string whole_seconds(double seconds) {
    return std::to_string(static_cast<long>(seconds + 0.5)) + " s";
}

/// A line that wraps could not be cleared again.
std::size_t line_length() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col - 1U
                                                                             : 79U;
}

void show_line(const std::string& words) {
    std::string line = visible(words);
    while (characters(line) > line_length()) {
        line.pop_back();
    }
    std::cerr << kClear << line << std::flush;
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

void Progress::silence() {
    silent = true;
}

Progress::Progress(std::string step) : step_(std::move(step)) {
    if (!silent && ::isatty(STDERR_FILENO) != 0) {
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

StatusLine::StatusLine() : terminal_(::isatty(STDERR_FILENO) != 0) {}

StatusLine::~StatusLine() {
    clear();
}

void StatusLine::clear() {
    if (shown_) {
        std::cerr << kClear << std::flush;
        shown_ = false;
    }
}

void StatusLine::show(const std::string& words) {
    if (terminal_) {
        show_line(words);
        shown_ = true;
    }
}

void StatusLine::note(const std::string& words) const {
    if (!terminal_) {
        std::cerr << visible(words) << std::endl;
    }
}

void Progress::watch() {
    const Stopwatch clock;
    bool shown = false;
    std::unique_lock<std::mutex> lock(mutex_);
    while (!wake_.wait_for(lock, kPeriod, [this] { return over_; })) {
        if (clock.seconds() > kQuietSeconds) {
            show_line(progress_line(step_, clock.seconds(), share_));
            shown = true;
        }
    }
    if (shown) {
        std::cerr << kClear << std::flush;
    }
}

} // namespace degs::sim
