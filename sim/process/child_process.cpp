// SPDX-License-Identifier: Apache-2.0
#include "sim/process/child_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/parallel.hpp"
#include "sim/process/interruption.hpp"
#include "sim/process/stopping_signals.hpp"

namespace degs::sim {
namespace {

constexpr int kTickMilliseconds = 250;

/// First byte of what a child writes; the text follows.
enum Tag : char { kOutput = 'o', kMistake = 'm', kBroken = 'b' };

Failure child_failure(int code, const std::string& job, const std::string& sentence) {
    return {code, job + ": " + sentence};
}

void write_all(int file, const std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
        const ssize_t written = ::write(file, bytes.data() + at, bytes.size() - at);
        if (written < 0 && errno != EINTR) {
            return; // the parent is gone, and with it the reader
        }
        at += std::max<ssize_t>(written, 0);
    }
}

/// Does the work; the first byte reports how it ended.
std::string message_of(const ChildJob& job) {
    try {
        return static_cast<char>(kOutput) + job.work();
    } catch (...) {
        const Failure failure = failure_of(std::current_exception());
        return static_cast<char>(failure.code == kUserError ? kMistake : kBroken) +
               failure.sentence;
    }
}

} // namespace

/// A forked child and the end of the pipe from which its message comes. Killed when destroyed.
class ChildPool::Child {
public:
    Child(std::size_t index, const ChildJob& job, int threads, const StoppingSignals& signals);
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
    [[noreturn]] static void run(const ChildJob& job, int threads, int write_end, pid_t parent,
                                 const StoppingSignals& signals);
    ChildOutcome failed(const std::string& sentence) const {
        return {{}, child_failure(kInternalError, name_, sentence)};
    }

    std::size_t index_;
    std::string name_;
    pid_t pid_ = -1;
    int read_end_ = -1;
    std::string message_;
};

ChildPool::Child::Child(std::size_t index, const ChildJob& job, int threads,
                        const StoppingSignals& signals)
    : index_(index), name_(job.name) {
    std::array<int, 2> ends{-1, -1};
    const pid_t parent = ::getpid();
    // Otherwise both processes would write the text that waits in a buffer.
    std::cout.flush();
    std::fflush(nullptr);
    if (::pipe2(ends.data(), O_CLOEXEC) != 0 || (pid_ = ::fork()) < 0) {
        const int reason = errno;
        for (int end : ends) {
            if (end >= 0) {
                ::close(end);
            }
        }
        throw FailureError(child_failure(kInternalError, name_,
                                         std::string("No process could be started: ") +
                                             std::strerror(reason) + "."));
    }
    if (pid_ == 0) {
        ::close(ends[0]);
        run(job, threads, ends[1], parent, signals);
    }
    ::close(ends[1]);
    read_end_ = ends[0];
}

ChildPool::Child::~Child() {
    if (pid_ > 0) {
        ::kill(pid_, SIGKILL);
        while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    if (read_end_ >= 0) {
        ::close(read_end_);
    }
}

void ChildPool::Child::run(const ChildJob& job, int threads, int write_end, pid_t parent,
                           const StoppingSignals& signals) {
    limit_host_threads(threads);
    keep_interruption_quiet();
    signals.restore();
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() == parent) { // else the parent died before it could be watched
        write_all(write_end, message_of(job));
    }
    ::_exit(kSuccess);
}

bool ChildPool::Child::read() {
    std::array<char, 65536> part;
    const ssize_t count = ::read(read_end_, part.data(), part.size());
    if (count > 0) {
        message_.append(part.data(), count);
    }
    return count == 0 || (count < 0 && errno != EINTR);
}

ChildOutcome ChildPool::Child::outcome() {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    if (WIFSIGNALED(status)) {
        return failed(ending_sentence(WTERMSIG(status)));
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
    return {{}, child_failure(tag == kMistake ? kUserError : kInternalError, name_, message_)};
}

ChildPool::ChildPool(int at_once, ChildWatcher watcher)
    : at_once_(std::max(at_once, 1)), watcher_(std::move(watcher)) {}

ChildPool::~ChildPool() = default;

bool ChildPool::make_room() {
    return wait_for_fewer_than(at_once_, StoppingSignals());
}

bool ChildPool::finish() {
    return wait_for_fewer_than(1, StoppingSignals());
}

bool ChildPool::start(const ChildJob& job) {
    const StoppingSignals signals;
    if (!wait_for_fewer_than(at_once_, signals)) {
        return false;
    }
    const std::size_t index = started_++;
    try {
        // Processes that run beside each other share the processors.
        const int threads = host_threads() / static_cast<int>(at_once_);
        running_.push_back(std::make_unique<Child>(index, job, threads, signals));
    } catch (const FailureError& error) {
        ++ended_;
        watcher_.ended(index, {{}, error.failure()});
    }
    return true;
}

bool ChildPool::wait_for_fewer_than(std::size_t count, const StoppingSignals& signals) {
    while (!stopped_ && running_.size() >= count) {
        std::vector<pollfd> files; // one per child, then the signals
        for (const auto& child : running_) {
            files.push_back({child->file(), POLLIN, 0});
        }
        files.push_back({signals.file(), POLLIN, 0});
        const bool any = ::poll(files.data(), files.size(), kTickMilliseconds) > 0;
        if (signals.take()) {
            running_.clear();
            return false;
        }
        for (std::size_t i = running_.size(); any && !stopped_ && i-- > 0;) {
            if (files[i].revents != 0 && running_[i]->read()) {
                take(i);
            }
        }
        tell_watcher();
    }
    if (stopped_) {
        running_.clear();
    }
    return !stopped_;
}

void ChildPool::take(std::size_t place) {
    const std::unique_ptr<Child> child = std::move(running_[place]);
    running_.erase(running_.begin() + place);
    ++ended_;
    watcher_.ended(child->index(), child->outcome());
}

void ChildPool::tell_watcher() const {
    if (watcher_.tick) {
        std::vector<std::size_t> indices;
        for (const auto& child : running_) {
            indices.push_back(child->index());
        }
        watcher_.tick(ended_, indices);
    }
}

bool run_children(const std::vector<ChildJob>& jobs, int at_once, const ChildWatcher& watcher) {
    ChildPool pool(at_once, watcher);
    return std::all_of(jobs.begin(), jobs.end(),
                       [&pool](const ChildJob& job) { return pool.start(job); }) &&
           pool.finish();
}

} // namespace degs::sim
