// SPDX-License-Identifier: Apache-2.0
#include "sim/process/stopping_signals.hpp"

#include <cerrno>
#include <system_error>

#include <sys/signalfd.h>
#include <unistd.h>

#include "sim/process/failure.hpp"

namespace degs::sim {
namespace {

int last_signal = SIGINT;

} // namespace

int interruption_code() {
    return kOfSignals + last_signal;
}

StoppingSignals::StoppingSignals() {
    sigset_t held;
    sigemptyset(&held);
    for (int signal : {SIGINT, SIGTERM}) {
        struct sigaction action {};
        ::sigaction(signal, nullptr, &action);
        if (action.sa_handler != SIG_IGN) {
            sigaddset(&held, signal);
        }
    }
    file_ = ::signalfd(-1, &held, SFD_CLOEXEC | SFD_NONBLOCK);
    if (file_ < 0) {
        throw std::system_error(errno, std::generic_category(), "no file for signals");
    }
    ::pthread_sigmask(SIG_BLOCK, &held, &before_);
}

StoppingSignals::~StoppingSignals() {
    restore();
    ::close(file_);
}

bool StoppingSignals::take() const {
    signalfd_siginfo info{};
    bool any = false;
    while (::read(file_, &info, sizeof info) == sizeof info) {
        last_signal = static_cast<int>(info.ssi_signo);
        any = true;
    }
    return any;
}

void StoppingSignals::restore() const {
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

} // namespace degs::sim
