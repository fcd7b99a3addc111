// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>

namespace degs {

/// A mutex of two threads that each gets in turn: one that takes it again at once waits until the
/// other, if it is waiting, has had it.
class TurnMutex {
public:
    void lock() {
        const std::lock_guard<std::mutex> next(next_);
        held_.lock();
    }
    void unlock() { held_.unlock(); }

private:
    std::mutex next_, held_;
};

} // namespace degs
