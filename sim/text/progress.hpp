// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace degs::sim {

/// One line on stderr that shows the progress of a long step, from its third second on and only on
/// a terminal; it disappears when the step ends. A thread of its own prints it, so that steps that
/// cannot be asked (loading, the reference render) have one too.
class Progress {
public:
    explicit Progress(std::string step);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Share of the step that is done, 0 .. 1.
    void done(double share) { share_ = share; }

    /// Objects made from now on print nothing, for processes whose parent shows the progress.
    static void silence();

private:
    void watch();

    std::string step_;
    std::atomic<double> share_{0.0};
    std::mutex mutex_;
    std::condition_variable wake_;
    bool over_ = false;
    std::thread watcher_;
};

/// A line on stderr that its owner keeps up to date, on a terminal only; it disappears with its
/// owner. Where there is no terminal, lines of their own can be noted.
class StatusLine {
public:
    StatusLine();
    ~StatusLine();
    StatusLine(const StatusLine&) = delete;
    StatusLine& operator=(const StatusLine&) = delete;
    void show(const std::string& words);
    void note(const std::string& words) const;
    /// The line disappears until the next show().
    void clear();

private:
    bool terminal_;
    bool shown_ = false;
};

/// "simulation 42 % · 12 s, about 17 s to go"; without a share, the time alone.
std::string progress_line(const std::string& step, double seconds, double share);

} // namespace degs::sim
