// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>

namespace degs::sim {

/// Holds back SIGINT (Ctrl-C) and SIGTERM while it lives, so that a wait can end in an orderly way.
/// A signal that the program was started to ignore stays ignored.
class StoppingSignals {
public:
    StoppingSignals();
    ~StoppingSignals();
    StoppingSignals(const StoppingSignals&) = delete;
    StoppingSignals& operator=(const StoppingSignals&) = delete;

    /// Readable when a signal has arrived.
    int file() const { return file_; }
    /// Whether a signal has arrived; takes it, so that it does nothing else, and remembers it for
    /// interruption_code().
    bool take() const;
    /// Signals act again as before; for a forked child.
    void restore() const;

private:
    sigset_t before_{};
    int file_ = -1;
};

/// The exit code of a program that the signal ends which was taken last, by default SIGINT: the one
/// that shells show, 130 or 143.
int interruption_code();

} // namespace degs::sim
