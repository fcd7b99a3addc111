// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <sys/types.h>

namespace degs::sim {

/// A copy of this process that waits and takes its place when it is called, because SystemC
/// elaborates once per process: whoever tries a simulation that may come to nothing needs another
/// process for the next. The caller has no other thread, since a fork copies only its own.
class Reserve {
public:
    /// Returns in this process and, if the reserve is called, in the copy as well. Without a copy,
    /// because the system refused one, available() is false.
    Reserve();
    ~Reserve(); ///< dismisses the copy, if it still waits
    Reserve(const Reserve&) = delete;
    Reserve& operator=(const Reserve&) = delete;

    bool available() const { return pid_ > 0; }
    /// The reason for which the copy has been called; empty in the original process.
    const std::string& called_for() const { return reason_; }
    /// In the copy, once it has been called: processor seconds of the process that it replaces,
    /// from the start of that process. They belong to what a CpuStopwatch shows that was started
    /// before the copy, because the clock of the copy begins at 0. Else 0.
    double replaced_s() const { return replaced_s_; }
    /// The copy goes on in place of this process, which ends when the copy does, with its exit
    /// code. `reason` is not empty.
    [[noreturn]] void call(const std::string& reason);

private:
    pid_t pid_ = -1;
    int order_ = -1; ///< the copy waits for a text from here
    std::string reason_;
    double replaced_s_ = 0;
};

} // namespace degs::sim
