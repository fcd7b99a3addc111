// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <tuple>

#include <systemc>

#include "degs/options.hpp"
#include "tlm/clock_domain.hpp"

namespace degs {

/// The one place that decides when an access goes out. Must be called from threads.
class AccessPacer {
public:
    AccessPacer(Pacing pacing, const ClockDomain& clock) : pacing_(pacing), clock_(clock) {}

    /// Waits until the access of the stream `rank`, which is dated `delay` from now, may be issued.
    /// `delay` is then what remains to be annotated.
    void await_turn(unsigned rank, sc_core::sc_time& delay);
    /// Turns the delay to an answer into what the stream sees, after await_turn().
    void settle(sc_core::sc_time& delay) const;
    /// Lets every access go out at once, until close() is called.
    void open();
    void close() { open_ = false; }

private:
    using Turn = std::tuple<std::uint64_t, unsigned, std::uint64_t>; // date, rank, number
    /// The place of a waiting access in the order, left even by a thread that is killed.
    class Place {
    public:
        Place(AccessPacer& pacer, const Turn& turn)
            : pacer_(pacer), turn_(pacer.turns_.insert(turn).first) {}
        Place(const Place&) = delete;
        Place& operator=(const Place&) = delete;
        ~Place();
        bool first() const { return turn_ == pacer_.turns_.begin(); }

    private:
        AccessPacer& pacer_;
        std::set<Turn>::iterator turn_;
    };
    bool exact() const;

    Pacing pacing_;
    ClockDomain clock_;
    std::set<Turn> turns_;
    std::uint64_t numbers_ = 0;
    bool open_ = false;
    sc_core::sc_event next_turn_, opens_;
};

} // namespace degs
