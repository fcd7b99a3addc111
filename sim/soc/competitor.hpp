// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>

#include <systemc>

#include "sim/soc/soc_host.hpp"

namespace degs::sim {

/// The program of an accelerator that renders while another one is measured: it begins a frame in
/// every period, or, if the one before takes longer, when that has ended.
class Competitor {
public:
    struct Counts {
        std::uint64_t frames = 0; ///< that have ended
        std::uint64_t late = 0;   ///< of those, longer than the period
        double latency_ns = 0;    ///< of all of them together
        Counts since(const Counts& earlier) const;
    };

    /// `prepare` gives the host scene, images and memory.
    Competitor(SocHost& host, std::function<void(SocHost&)> prepare);
    Competitor(const Competitor&) = delete;
    Competitor& operator=(const Competitor&) = delete;
    ~Competitor() = default;

    /// Begins a frame now and then so many per second; 0 lets the present frame be the last.
    void set_rate(double frames_per_s);
    /// Waits, in a process of the kernel, until no frame is rendered. Only while the rate is 0.
    void wait_until_idle();
    const Counts& counts() const { return counts_; }

private:
    void run(SocHost& host);
    void render(SocHost& host);

    std::function<void(SocHost&)> prepare_;
    double rate_per_s_ = 0;
    sc_core::sc_time due_; // of the next frame
    bool idle_ = false;
    Counts counts_;
    sc_core::sc_event rate_changed_, stopped_;
};

} // namespace degs::sim
