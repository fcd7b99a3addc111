// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <systemc>

namespace degs {

/// A date or a duration in cycles of one clock domain. All block-local time is integer.
using Cycle = std::uint64_t;
/// Later than anything; half the range, so that adding a latency cannot wrap.
constexpr Cycle kNever = ~Cycle{0} / 2;

/// Converts between cycles and kernel time; nothing else does. The model has no clock signal.
class ClockDomain {
public:
    /// `gigahertz` > 0; the period is rounded to the kernel's time resolution.
    explicit ClockDomain(double gigahertz) : period_(1.0 / gigahertz, sc_core::SC_NS) {}

    sc_core::sc_time period() const { return period_; }
    sc_core::sc_time at(Cycle date) const {
        return sc_core::sc_time::from_value(date * period_.value());
    }
    /// Half a cycle after `date`. Everything dated up to `date` has happened by then.
    sc_core::sc_time half_after(Cycle date) const {
        return sc_core::sc_time::from_value(date * period_.value() + period_.value() / 2);
    }
    /// First cycle that starts at or after `time`.
    Cycle ceil(const sc_core::sc_time& time) const {
        return (time.value() + period_.value() - 1) / period_.value();
    }
    /// Last cycle that starts at or before `time`.
    Cycle floor(const sc_core::sc_time& time) const { return time.value() / period_.value(); }

private:
    sc_core::sc_time period_;
};

} // namespace degs
