// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <queue>
#include <vector>

#include <systemc>

namespace degs {

/// A bound on the LT transactions that are not answered yet: one goes out when fewer than `most`
/// others end after its date.
class InFlight {
public:
    /// Bounds the accesses in flight to `most`; 0 means no bound.
    explicit InFlight(unsigned most) : most_(most) {}

    bool bounded() const { return most_ != 0; }
    /// The first date from `date` on at which one more may go out. Dates never fall by more than
    /// what is annotated to a transaction.
    sc_core::sc_time admit(const sc_core::sc_time& date) {
        while (!ends_.empty() && ends_.top() <= date) {
            ends_.pop();
        }
        return ends_.size() < most_ ? date : ends_.top();
    }
    /// Adds an access that has gone out at the date which admit() returned, and is answered at
    /// `end`.
    void add(const sc_core::sc_time& end) { ends_.push(end); }

private:
    unsigned most_;
    std::priority_queue<sc_core::sc_time, std::vector<sc_core::sc_time>, std::greater<>> ends_;
};

} // namespace degs
