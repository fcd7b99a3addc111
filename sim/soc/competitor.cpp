// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/competitor.hpp"

#include <algorithm>
#include <utility>

namespace degs::sim {

Competitor::Counts Competitor::Counts::since(const Counts& earlier) const {
    return {frames - earlier.frames, late - earlier.late, latency_ns - earlier.latency_ns};
}

Competitor::Competitor(SocHost& host, std::function<void(SocHost&)> prepare)
    : prepare_(std::move(prepare)) {
    host.program = [this](SocHost& own) { run(own); };
}

void Competitor::set_rate(double frames_per_s) {
    rate_per_s_ = frames_per_s;
    due_ = sc_core::sc_time_stamp();
    rate_changed_.notify(sc_core::SC_ZERO_TIME);
}

void Competitor::wait_until_idle() {
    while (!idle_) {
        sc_core::wait(stopped_);
    }
}

void Competitor::run(SocHost& host) {
    prepare_(host);
    for (;;) {
        while (rate_per_s_ <= 0) {
            idle_ = true;
            stopped_.notify(sc_core::SC_ZERO_TIME);
            sc_core::wait(rate_changed_);
        }
        idle_ = false;
        if (due_ > sc_core::sc_time_stamp()) {
            sc_core::wait(due_ - sc_core::sc_time_stamp(), rate_changed_);
        } else {
            render(host);
        }
    }
}

void Competitor::render(SocHost& host) {
    const sc_core::sc_time period(1 / rate_per_s_, sc_core::SC_SEC);
    due_ += period;
    const double ns = host.render().latency_ns;
    ++counts_.frames;
    counts_.late += ns > period.to_seconds() * 1e9 ? 1 : 0;
    counts_.latency_ns += ns;
    due_ = std::max(due_, sc_core::sc_time_stamp());
}

} // namespace degs::sim
