// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/display.hpp"

#include <algorithm>

#include "tlm/has_process.hpp"
#include "tlm/set_access.hpp"

namespace degs::sim {

Display::Display(const sc_core::sc_module_name& name, const Config& config)
    : sc_core::sc_module(name), out("out"), config_(config), row_(4 * config.width) {
    DEGS_HAS_PROCESS(Display);
    SC_THREAD(run);
}

void Display::show(std::uint64_t frame_buffer) {
    frame_buffer_ = frame_buffer;
    on_ = true;
    turned_on_.notify(sc_core::SC_ZERO_TIME);
}

void Display::run() {
    while (!on_) {
        sc_core::wait(turned_on_);
    }
    const sc_core::sc_time row_time(1.0 / config_.refresh_hz / config_.height, sc_core::SC_SEC);
    sc_core::sc_time due = sc_core::sc_time_stamp();
    for (;; ++stats_.pictures) {
        const std::uint64_t picture = frame_buffer_;
        for (int y = 0; y < config_.height; ++y, ++stats_.rows) {
            if (due > sc_core::sc_time_stamp()) {
                sc_core::wait(due - sc_core::sc_time_stamp());
            }
            due += row_time;
            const sc_core::sc_time there = fetch_row(picture + y * row_.size());
            stats_.underruns += there > due ? 1 : 0;
        }
    }
}

// All requests of a row are made at once; the date at which the last one is answered.
sc_core::sc_time Display::fetch_row(std::uint64_t address) {
    sc_core::sc_time there = sc_core::sc_time_stamp();
    for (std::size_t at = 0; at < row_.size(); at += config_.request_bytes) {
        const auto bytes = static_cast<unsigned int>(
            std::min<std::size_t>(config_.request_bytes, row_.size() - at));
        tlm::tlm_generic_payload payload;
        set_access(payload, tlm::TLM_READ_COMMAND, address + at, row_.data() + at, bytes);
        sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
        out->b_transport(payload, delay);
        there = std::max(there, sc_core::sc_time_stamp() + delay);
        stats_.bytes += bytes;
        stats_.errors += payload.is_response_error() ? 1 : 0;
    }
    return there;
}

} // namespace degs::sim
