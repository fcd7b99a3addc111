// SPDX-License-Identifier: Apache-2.0
#include "sim/process/reserve.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <iostream>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace degs::sim {
namespace {

/// What comes before the end of the pipe.
std::string read_all(int file) {
    std::string text;
    std::array<char, 1024> part;
    for (;;) {
        const ssize_t count = ::read(file, part.data(), part.size());
        if (count > 0) {
            text.append(part.data(), count);
        } else if (count == 0 || errno != EINTR) {
            return text;
        }
    }
}

/// What all threads of a process have computed, s; 0 if the system does not say it.
double computed_by(pid_t process) {
    clockid_t clock = 0;
    timespec time{};
    if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &time) != 0) {
        return 0;
    }
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace

Reserve::Reserve() {
    std::array<int, 2> ends{-1, -1};
    // Otherwise both processes would write the text that waits in a buffer.
    std::cout.flush();
    std::fflush(nullptr);
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
        return;
    }
    pid_ = ::fork();
    if (pid_ == 0) {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        ::close(ends[1]);
        reason_ = read_all(ends[0]);
        ::close(ends[0]);
        if (reason_.empty()) {
            ::_exit(0);
        }
        replaced_s_ = computed_by(::getppid());
        return;
    }
    ::close(ends[0]);
    if (pid_ < 0) {
        ::close(ends[1]);
        return;
    }
    order_ = ends[1];
}

Reserve::~Reserve() {
    if (pid_ > 0) {
        ::close(order_);
        while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
}

void Reserve::call(const std::string& reason) {
    // A sentence fits the buffer of a pipe, so the write is not divided.
    while (::write(order_, reason.data(), reason.size()) < 0 && errno == EINTR) {
    }
    ::close(order_);
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFSIGNALED(status)) {
        ::signal(WTERMSIG(status), SIG_DFL);
        ::raise(WTERMSIG(status));
    }
    ::_exit(WEXITSTATUS(status));
}

} // namespace degs::sim
