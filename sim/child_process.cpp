// SPDX-License-Identifier: Apache-2.0
#include "sim/child_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <memory>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "sim/stopping_signals.hpp"

namespace degs::sim {
namespace {

constexpr int kTickMilliseconds = 250;

/// First byte of what a child writes; the text follows.
enum Tag : char { kOutput = 'o', kMistake = 'm', kBroken = 'b' };

Failure child_failure(int code, const ChildJob& job, const std::string& sentence) {
    return {code, job.name + ": " + sentence};
}

void write_all(int file, const std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
        const ssize_t written = ::write(file, bytes.data() + at, bytes.size() - at);
        if (written < 0 && errno != EINTR) {
            return; // the parent is gone, and with it the reader
        }
        at += static_cast<std::size_t>(std::max<ssize_t>(written, 0));
    }
}

/// Does the work; the first byte says what came of it.
std::string message_of(const ChildJob& job) {
    try {
        return static_cast<char>(kOutput) + job.work();
    } catch (...) {
        const Failure failure = failure_of(std::current_exception());
        return static_cast<char>(failure.code == kUserError ? kMistake : kBroken) +
               failure.sentence;
    }
}

/// A forked child and the end of the pipe from which its message comes. Killed when destroyed.
class Child {
public:
    Child(std::size_t index, const ChildJob& job, const StoppingSignals& signals);
    ~Child();
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    std::size_t index() const { return index_; }
    int file() const { return read_end_; }
    /// Takes what is in the pipe; true when the child has closed it.
    bool read();
    /// Waits for the end of the child, whose pipe is closed.
    ChildOutcome outcome();

private:
    [[noreturn]] void run(int write_end, pid_t parent, const StoppingSignals& signals);
    ChildOutcome failed(const std::string& sentence) const {
        return {{}, child_failure(kInternalError, *job_, sentence)};
    }

    std::size_t index_;
    const ChildJob* job_;
    pid_t pid_ = -1;
    int read_end_ = -1;
    std::string message_;
};

Child::Child(std::size_t index, const ChildJob& job, const StoppingSignals& signals)
    : index_(index), job_(&job) {
    std::array<int, 2> ends{-1, -1};
    const pid_t parent = ::getpid();
    // What waits in a buffer would otherwise be written by both.
    std::cout.flush();
    std::fflush(nullptr);
    if (::pipe2(ends.data(), O_CLOEXEC) != 0 || (pid_ = ::fork()) < 0) {
        const int reason = errno;
        for (int end : ends) {
            if (end >= 0) {
                ::close(end);
            }
        }
        throw FailureError(child_failure(kInternalError, job,
                                         std::string("No process could be started: ") +
                                             std::strerror(reason) + "."));
    }
    if (pid_ == 0) {
        ::close(ends[0]);
        run(ends[1], parent, signals);
    }
    ::close(ends[1]);
    read_end_ = ends[0];
}

Child::~Child() {
    if (pid_ > 0) {
        ::kill(pid_, SIGKILL);
        while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    if (read_end_ >= 0) {
        ::close(read_end_);
    }
}

void Child::run(int write_end, pid_t parent, const StoppingSignals& signals) {
    signals.restore();
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() == parent) { // else the parent died before it could be watched
        write_all(write_end, message_of(*job_));
    }
    ::_exit(kSuccess);
}

bool Child::read() {
    std::array<char, 65536> part;
    const ssize_t count = ::read(read_end_, part.data(), part.size());
    if (count > 0) {
        message_.append(part.data(), static_cast<std::size_t>(count));
    }
    return count == 0 || (count < 0 && errno != EINTR);
}

ChildOutcome Child::outcome() {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        return failed("The process was ended by signal " + std::to_string(signal) + " (" +
                      ::strsignal(signal) + ")" +
                      (signal == SIGKILL ? "; the machine may have run out of memory." : "."));
    }
    if (message_.empty() || WEXITSTATUS(status) != kSuccess) {
        return failed("The process ended without a result and with exit code " +
                      std::to_string(WEXITSTATUS(status)) + ".");
    }
    const char tag = message_.front();
    message_.erase(0, 1);
    if (tag == kOutput) {
        return {std::move(message_), {}};
    }
    return {{}, child_failure(tag == kMistake ? kUserError : kInternalError, *job_, message_)};
}

using Children = std::vector<std::unique_ptr<Child>>;

/// Waits for a message, a tick or a signal. One entry per child, then the signals.
std::vector<pollfd> wait_for(const Children& children, const StoppingSignals& signals) {
    std::vector<pollfd> files;
    for (const auto& child : children) {
        files.push_back({child->file(), POLLIN, 0});
    }
    files.push_back({signals.file(), POLLIN, 0});
    if (::poll(files.data(), files.size(), kTickMilliseconds) < 0) {
        for (pollfd& file : files) {
            file.revents = 0;
        }
    }
    return files;
}

void start_children(const std::vector<ChildJob>& jobs, std::size_t& next, int at_once,
                    Children& running, const StoppingSignals& signals, const ChildWatcher& watcher,
                    std::size_t& ended) {
    while (next < jobs.size() && running.size() < static_cast<std::size_t>(at_once)) {
        const std::size_t index = next++;
        try {
            running.push_back(std::make_unique<Child>(index, jobs[index], signals));
        } catch (const FailureError& error) {
            ++ended;
            watcher.ended(index, {{}, error.failure()});
        }
    }
}

std::vector<std::size_t> indices_of(const Children& children) {
    std::vector<std::size_t> indices;
    for (const auto& child : children) {
        indices.push_back(child->index());
    }
    return indices;
}

} // namespace

bool run_children(const std::vector<ChildJob>& jobs, int at_once, const ChildWatcher& watcher) {
    const StoppingSignals signals;
    Children running;
    std::size_t next = 0;
    std::size_t ended = 0;
    start_children(jobs, next, at_once, running, signals, watcher, ended);
    while (!running.empty()) {
        const std::vector<pollfd> files = wait_for(running, signals);
        if (signals.take()) {
            return false;
        }
        for (std::size_t i = running.size(); i-- > 0;) {
            if (files[i].revents != 0 && running[i]->read()) {
                ++ended;
                watcher.ended(running[i]->index(), running[i]->outcome());
                running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
            }
        }
        start_children(jobs, next, at_once, running, signals, watcher, ended);
        if (watcher.tick) {
            watcher.tick(ended, indices_of(running));
        }
    }
    return true;
}

} // namespace degs::sim
