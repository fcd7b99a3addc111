// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/cpu_traffic.hpp"

#include <algorithm>

#include "tlm/has_process.hpp"
#include "tlm/memory.hpp"
#include "tlm/set_access.hpp"

namespace degs::sim {

CpuTraffic::CpuTraffic(const sc_core::sc_module_name& name, const Config& config)
    : sc_core::sc_module(name), out("out"), config_(config), random_(config.seed),
      done_(config.lines_in_flight), line_(kLineBytes) {
    info_.qos = config_.qos;
    DEGS_HAS_PROCESS(CpuTraffic);
    SC_THREAD(run);
}

void CpuTraffic::set_rate(double gb_per_s) {
    rate_ = gb_per_s;
    rate_changed_.notify(sc_core::SC_ZERO_TIME);
}

void CpuTraffic::run() {
    sc_core::sc_time due;
    for (;;) {
        while (rate_ <= 0) {
            sc_core::wait(rate_changed_);
        }
        due = std::max(due, sc_core::sc_time_stamp());
        if (due > sc_core::sc_time_stamp()) {
            sc_core::wait(due - sc_core::sc_time_stamp(), rate_changed_);
            if (due > sc_core::sc_time_stamp()) {
                due = sc_core::sc_time_stamp(); // another rate
                continue;
            }
        }
        due += sc_core::sc_time(kLineBytes / rate_, sc_core::SC_NS);
        move_line();
    }
}

std::uint64_t CpuTraffic::next_address() {
    const std::uint64_t lines = config_.bytes / kLineBytes;
    const std::uint64_t line =
        config_.pattern == Pattern::Stream ? next_line_++ % lines : random_() % lines;
    return config_.begin + line * kLineBytes;
}

void CpuTraffic::move_line() {
    sc_core::sc_time& oldest = done_[moved_++ % done_.size()];
    if (oldest > sc_core::sc_time_stamp()) {
        sc_core::wait(oldest - sc_core::sc_time_stamp());
    }
    const std::uint64_t of = config_.reads_per_write + 1;
    const bool write = of > 1 && random_() % of == 0;
    TimingOnly timing_only;
    tlm::tlm_generic_payload payload;
    payload.set_extension(&timing_only);
    payload.set_extension(&info_);
    set_access(payload, write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND, next_address(),
               line_.data(), kLineBytes);
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    out->b_transport(payload, delay);
    payload.clear_extension(&timing_only);
    payload.clear_extension(&info_);
    oldest = sc_core::sc_time_stamp() + delay;
    bytes_moved_ += kLineBytes;
    errors_ += payload.is_response_error() ? 1 : 0;
}

} // namespace degs::sim
