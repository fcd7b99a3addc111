// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <utility>

#include <tlm>

#include "degs/request_info.hpp"

namespace degs {

/// A transaction that the platform has refused.
struct AccessFault {
    std::uint64_t address = 0;
    RequestStream stream = RequestStream::Other;
    tlm::tlm_response_status answer = tlm::TLM_OK_RESPONSE;
};

/// Transactions that were refused and wait until software lets them go out again or gives the frame
/// up; the oldest is the one that software sees.
class StalledAccesses {
public:
    /// `observer` is called whenever another one is the oldest.
    void observe(std::function<void()> observer) { observer_ = std::move(observer); }

    /// `again` is called once, by resume() or drop().
    void add(const AccessFault& fault, std::function<void()> again) {
        waiting_.emplace_back(fault, std::move(again));
        if (waiting_.size() == 1) {
            show();
        }
    }
    /// nullptr if none waits.
    const AccessFault* oldest() const {
        return waiting_.empty() ? nullptr : &waiting_.front().first;
    }
    /// Lets the oldest go out again, if there is one.
    void resume() {
        if (!waiting_.empty()) {
            const auto again = std::move(waiting_.front().second);
            waiting_.pop_front();
            again();
            show();
        }
    }
    /// Calls all of them, which then must end.
    void drop() {
        for (const auto& each : std::exchange(waiting_, {})) {
            each.second();
        }
    }

private:
    void show() const {
        if (observer_ && !waiting_.empty()) {
            observer_();
        }
    }
    std::deque<std::pair<AccessFault, std::function<void()>>> waiting_;
    std::function<void()> observer_;
};

} // namespace degs
