// SPDX-License-Identifier: Apache-2.0
#include "platform/access_pacer.hpp"

#include <algorithm>

#include <tlm>

namespace degs {

bool AccessPacer::exact() const {
    return pacing_ == Pacing::Exact ||
           (pacing_ == Pacing::Quantum &&
            tlm::tlm_global_quantum::instance().get() == sc_core::SC_ZERO_TIME);
}

void AccessPacer::await_turn(unsigned rank, sc_core::sc_time& delay) {
    if (pacing_ == Pacing::Annotated || open_) {
        return;
    }
    const sc_core::sc_time now = sc_core::sc_time_stamp();
    if (!exact()) {
        // As tlm_utils::tlm_quantumkeeper: who reaches the next multiple of the quantum waits for
        // its date.
        if (delay >= tlm::tlm_global_quantum::instance().compute_local_quantum()) {
            sc_core::wait(delay, opens_);
            delay = sc_core::SC_ZERO_TIME;
        }
        return;
    }
    const sc_core::sc_time due = std::max(clock_.half_after(clock_.floor(now + delay)), now);
    const Place place(*this, {due.value(), rank, numbers_++});
    if (due > now) {
        sc_core::wait(due - now, opens_);
    }
    while (!place.first() && !open_) {
        sc_core::wait(next_turn_);
    }
    delay = sc_core::SC_ZERO_TIME;
}

void AccessPacer::open() {
    open_ = true;
    opens_.notify(sc_core::SC_ZERO_TIME);
    next_turn_.notify(sc_core::SC_ZERO_TIME);
}

AccessPacer::Place::~Place() {
    pacer_.turns_.erase(turn_);
    if (!pacer_.turns_.empty()) {
        pacer_.next_turn_.notify(sc_core::SC_ZERO_TIME);
    }
}

void AccessPacer::settle(sc_core::sc_time& delay) const {
    if (exact()) {
        delay -= std::min(delay, sc_core::sc_time::from_value(clock_.period().value() / 2));
    }
}

} // namespace degs
