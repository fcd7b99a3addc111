// SPDX-License-Identifier: Apache-2.0
#include "tlm/clock_domain.hpp"

#include <algorithm>

#include "tlm/process.hpp"

namespace degs {
namespace {

// Two units of kernel time: one for each half of a cycle.
constexpr std::uint64_t kHurriedPeriod = 2;
// Cycles between what has happened before and after a change. Dates in rings are no more than a few
// latencies ahead of their processes, so none of them is still to come.
constexpr Cycle kGap = Cycle{1} << 20U;

} // namespace

sc_core::sc_time ClockMapping::place(Cycle date, std::uint64_t after) const {
    const Cycle cycles = date > origin_ ? date - origin_ : 0;
    return origin_time_ + sc_core::sc_time::from_value(cycles * pace_ + after);
}

Cycle ClockMapping::ceil(const sc_core::sc_time& time) const {
    if (time <= origin_time_) {
        return origin_;
    }
    return origin_ + ((time - origin_time_).value() + pace_ - 1) / pace_;
}

Cycle ClockMapping::floor(const sc_core::sc_time& time) const {
    if (time < origin_time_) {
        return std::max<Cycle>(origin_, 1) - 1;
    }
    return origin_ + (time - origin_time_).value() / pace_;
}

void ClockMapping::follow(const sc_core::sc_time& period, const sc_core::sc_time& first_edge) {
    period_ = period;
    pace_ = period.value();
    origin_time_ = first_edge_ = first_edge;
}

// The present cycle begins anew, so that its second half, when its order is certain, is still to
// come.
void ClockMapping::hurry() {
    const sc_core::sc_time now = sc_core::sc_time_stamp();
    origin_ = floor(now);
    origin_time_ = std::max(origin_time_, now);
    pace_ = std::min(pace_, kHurriedPeriod);
    for (Process* const process : processes_) {
        process->sleep_anew();
    }
}

bool ClockMapping::settled() const {
    return std::none_of(processes_.begin(), processes_.end(),
                        [](const Process* process) { return process->sleeps_to_date(); });
}

sc_core::sc_time ClockMapping::resume() {
    const sc_core::sc_time now = sc_core::sc_time_stamp();
    Cycle latest = floor(now);
    for (const Process* const process : processes_) {
        latest = process->local() == kNever ? latest : std::max(latest, process->local());
    }
    origin_ = latest + kGap;
    pace_ = period_.value();
    origin_time_ = first_edge_;
    if (now > first_edge_) {
        const std::uint64_t edges = ((now - first_edge_).value() + pace_ - 1) / pace_;
        origin_time_ += sc_core::sc_time::from_value(edges * pace_);
    }
    return origin_time_;
}

} // namespace degs
