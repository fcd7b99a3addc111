// SPDX-License-Identifier: Apache-2.0
#include "sim/serve/request_process.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <utility>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/parallel.hpp"
#include "sim/process/failure.hpp"
#include "sim/process/stopping_signals.hpp"

namespace degs::sim {
namespace {

/// Both ends of a pipe; -1 if the system gives none.
struct Pipe {
    std::array<int, 2> ends{-1, -1};
    Pipe() {
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
            ends = {-1, -1};
        }
    }
};

void close_file(int& file) {
    if (file >= 0) {
        ::close(std::exchange(file, -1));
    }
}

/// The standard streams of a fork: it reads nothing, and writes to the pipes.
void redirect(int out, int err) {
    const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
}

} // namespace

RequestProcess::RequestProcess(Request request, int threads, const std::function<WorkEnd()>& work,
                               const StoppingSignals& signals)
    : request_(std::move(request)) {
    // Otherwise both processes would write the text that waits in a buffer.
    std::cout.flush();
    std::fflush(nullptr);
    start(threads, work, signals);
}

void RequestProcess::start(int threads, const std::function<WorkEnd()>& work,
                           const StoppingSignals& signals) {
    Pipe out, err, made;
    const pid_t parent = ::getpid();
    if (out.ends[0] >= 0 && err.ends[0] >= 0 && made.ends[0] >= 0) {
        pid_ = ::fork();
    }
    const int reason = errno;
    if (pid_ == 0) {
        limit_host_threads(threads);
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        redirect(out.ends[1], err.ends[1]); // where a signal that has come speaks
        signals.restore();
        // Else the parent died before it could be watched.
        const WorkEnd end = ::getppid() == parent ? work() : WorkEnd{kInternalError};
        if (end.made && ::write(made.ends[1], "+", 1) < 0) {
            ::_exit(kInternalError);
        }
        std::cout.flush();
        std::cerr.flush();
        std::fflush(nullptr);
        ::_exit(end.code);
    }
    close_file(out.ends[1]);
    close_file(err.ends[1]);
    close_file(made.ends[1]);
    if (pid_ < 0) {
        close_file(out.ends[0]);
        close_file(err.ends[0]);
        close_file(made.ends[0]);
        err_.text =
            std::string("degs: No process could be started: ") + std::strerror(reason) + ".\n";
    }
    out_.file = out.ends[0];
    err_.file = err.ends[0];
    made_ = made.ends[0];
}

RequestProcess::~RequestProcess() {
    if (pid_ > 0) {
        ::kill(pid_, SIGKILL);
        while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    close_file(out_.file);
    close_file(err_.file);
    close_file(made_);
}

bool RequestProcess::Stream::read() {
    std::array<char, 65536> part;
    const ssize_t count = ::read(file, part.data(), part.size());
    if (count > 0) {
        text.append(part.data(), count);
    }
    return count > 0 || (count < 0 && errno == EINTR);
}

void RequestProcess::read(std::size_t stream) {
    Stream& own = stream == 0 ? out_ : err_;
    if (!own.read()) {
        close_file(own.file);
    }
}

std::vector<std::string> RequestProcess::take_lines() {
    std::vector<std::string> lines;
    std::string& text = err_.text;
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos;) {
        lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    text.erase(0, begin);
    if (err_.file < 0 && !text.empty()) {
        lines.push_back(std::exchange(text, ""));
    }
    return lines;
}

WorkEnd RequestProcess::end() {
    if (pid_ < 0) {
        return {kInternalError};
    }
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    if (!WIFSIGNALED(status)) {
        char byte = 0;
        return {WEXITSTATUS(status), ::read(made_, &byte, 1) == 1};
    }
    const int signal = WTERMSIG(status);
    if (signal != SIGINT && signal != SIGTERM) { // after these the process has said it itself
        err_.text += (err_.text.empty() ? "degs: " : "\ndegs: ") + ending_sentence(signal);
    }
    return {kOfSignals + signal};
}

void RequestProcess::interrupt() const {
    if (pid_ > 0) {
        ::kill(pid_, SIGINT);
    }
}

} // namespace degs::sim
