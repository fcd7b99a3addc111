// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <tuple>

#include <systemc>

#include "tlm/clock_domain.hpp"

namespace degs {

/// When an accelerator issues the accesses of its streams. Its blocks run ahead of the kernel on dates of
/// their own, which a memory that serves transactions in the order of the calls must not see.
///
/// `Exact`: at their dates, half a cycle late, when no stream can make another one of the same date; in the
/// order of the streams where dates are equal. The half cycle is taken off the answer again. What a
/// memory sees then depends on dates alone, not on the order in which the host runs processes.
/// `Quantum`: annotated up to the next multiple of the tlm::tlm_global_quantum, as a quantum keeper does;
/// an access beyond it waits for its date. `Exact` if there is no quantum.
/// `Annotated`: at once, however far ahead. For targets that sort by date, such as the memories of this
/// project: a context switch less per access.
enum class Pacing { Exact, Quantum, Annotated };

/// The one place that decides when an access goes out. Must be called from threads.
class AccessPacer {
public:
    AccessPacer(Pacing pacing, const ClockDomain& clock) : pacing_(pacing), clock_(clock) {}

    /// Waits until the access of the stream `rank`, which is dated `delay` from now, may be issued.
    /// `delay` is then what remains to be annotated.
    void await_turn(unsigned rank, sc_core::sc_time& delay);
    /// Turns the delay to an answer into what the stream sees, after await_turn().
    void settle(sc_core::sc_time& delay) const;
    /// Nobody waits any more, until close().
    void open();
    void close() { open_ = false; }

private:
    using Turn = std::tuple<std::uint64_t, unsigned, std::uint64_t>; // date, rank, number
    /// Of a waiting access, left even by a thread that is killed.
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
