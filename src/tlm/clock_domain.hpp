// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <systemc>

namespace degs {

class Process;

/// A date or a duration in cycles of one clock domain. All block-local time is integer.
using Cycle = std::uint64_t;
/// Later than anything; half the range, so that adding a latency cannot wrap.
constexpr Cycle kNever = ~Cycle{0} / 2;

/// Where the cycles of a clock domain lie in kernel time, for a domain that needs more than
/// multiples of a period: its edges may have a phase, and it can hurry through work that nobody
/// wants any more. Every ClockDomain made from it, copies included, asks the one mapping. Dates
/// before the origin of the present mapping lie at its origin, so that they are never in the
/// future.
class ClockMapping {
public:
    explicit ClockMapping(const sc_core::sc_time& period)
        : period_(period), pace_(period.value()) {}
    ClockMapping(const ClockMapping&) = delete;
    ClockMapping& operator=(const ClockMapping&) = delete;
    ~ClockMapping() = default;

    /// Follows the edges of another clock from its first one on: before the simulation starts, or
    /// right before resume().
    void follow(const sc_core::sc_time& period, const sc_core::sc_time& first_edge);
    /// From now on a cycle takes two units of kernel time, the fewest that keep the two halves of a
    /// cycle apart. Sleeping processes are woken, so that they sleep to the new times.
    void hurry();
    /// Ends hurry(): the next edge of the clock, which is returned, begins a cycle later than every
    /// date so far. Only while settled().
    sc_core::sc_time resume();
    /// True if no process sleeps to a date.
    bool settled() const;

    /// ClockDomain says what these functions return.
    const sc_core::sc_time& period() const { return period_; }
    sc_core::sc_time at(Cycle date) const { return place(date, 0); }
    sc_core::sc_time half_after(Cycle date) const { return place(date, pace_ / 2); }
    Cycle ceil(const sc_core::sc_time& time) const;
    Cycle floor(const sc_core::sc_time& time) const;

    /// For Process, which must live as long as somebody calls hurry() or resume().
    void join(Process& process) { processes_.push_back(&process); }

private:
    sc_core::sc_time place(Cycle date, std::uint64_t after) const;

    sc_core::sc_time period_, first_edge_;
    std::uint64_t pace_; // kernel time units of a cycle at present
    Cycle origin_ = 0;   // begins at origin_time_
    sc_core::sc_time origin_time_;
    std::vector<Process*> processes_;
};

/// Converts between cycles and kernel time; nothing else does. The model has no clock signal.
class ClockDomain {
public:
    /// `gigahertz` > 0; the period is rounded to the kernel's time resolution. Cycle 0 begins at 0.
    explicit ClockDomain(double gigahertz) : period_(1.0 / gigahertz, sc_core::SC_NS) {}
    /// The cycles lie where `mapping` says, which must outlive the domain.
    explicit ClockDomain(ClockMapping& mapping) : period_(mapping.period()), mapping_(&mapping) {}

    /// nullptr: cycles are multiples of the period for ever.
    ClockMapping* mapping() const { return mapping_; }
    sc_core::sc_time period() const { return mapping_ == nullptr ? period_ : mapping_->period(); }
    sc_core::sc_time at(Cycle date) const {
        if (mapping_ != nullptr) {
            return mapping_->at(date);
        }
        return sc_core::sc_time::from_value(date * period_.value());
    }
    /// The time half a cycle after `date`. Everything dated up to `date` has happened by then.
    sc_core::sc_time half_after(Cycle date) const {
        if (mapping_ != nullptr) {
            return mapping_->half_after(date);
        }
        return sc_core::sc_time::from_value(date * period_.value() + period_.value() / 2);
    }
    /// True if half_after(date) <= time.
    bool past_half(Cycle date, const sc_core::sc_time& time) const {
        return mapping_ != nullptr ? mapping_->half_after(date) <= time
                                   : date * period_.value() + period_.value() / 2 <= time.value();
    }
    /// First cycle that starts at or after `time`.
    Cycle ceil(const sc_core::sc_time& time) const {
        return mapping_ != nullptr ? mapping_->ceil(time) : cycles_of(time);
    }
    /// Last cycle that starts at or before `time`.
    Cycle floor(const sc_core::sc_time& time) const {
        return mapping_ != nullptr ? mapping_->floor(time) : time.value() / period_.value();
    }
    /// Periods that a duration takes, rounded up.
    Cycle cycles_of(const sc_core::sc_time& duration) const {
        const std::uint64_t period = this->period().value();
        return (duration.value() + period - 1) / period;
    }

private:
    sc_core::sc_time period_;
    ClockMapping* mapping_ = nullptr;
};

} // namespace degs
