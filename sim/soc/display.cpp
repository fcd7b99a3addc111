// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/display.hpp"

#include <algorithm>
#include <utility>

#include "tlm/has_process.hpp"
#include "tlm/set_access.hpp"

namespace degs::sim {

Display::Display(const sc_core::sc_module_name& name, const Config& config)
    : sc_core::sc_module(name), out("out"), config_(config) {
    info_.qos = config_.qos;
    DEGS_HAS_PROCESS(Display);
    SC_THREAD(run);
}

void Display::show(std::vector<Part> frame) {
    frame_ = std::move(frame);
    turned_on_.notify(sc_core::SC_ZERO_TIME);
}

void Display::run() {
    while (frame_.empty()) {
        sc_core::wait(turned_on_);
    }
    due_ = sc_core::sc_time_stamp();
    for (;; ++stats_.pictures) {
        show_picture(std::vector<Part>(frame_)); // which may be replaced meanwhile
    }
}

void Display::show_picture(const std::vector<Part>& picture) {
    int rows = 0;
    for (const Part& part : picture) {
        rows += part.height;
    }
    const sc_core::sc_time row_time(1.0 / config_.refresh_hz / rows, sc_core::SC_SEC);
    for (const Part& part : picture) {
        const std::uint64_t row_bytes = 4 * static_cast<std::uint64_t>(part.width);
        for (int y = 0; y < part.height; ++y, ++stats_.rows) {
            if (due_ > sc_core::sc_time_stamp()) {
                sc_core::wait(due_ - sc_core::sc_time_stamp());
            }
            due_ += row_time;
            const sc_core::sc_time there = fetch_row(part.address + y * row_bytes, part.width);
            stats_.underruns += there > due_ ? 1 : 0;
        }
    }
}

// All requests of a row are made at once; the date at which the last one is answered.
sc_core::sc_time Display::fetch_row(std::uint64_t address, int width) {
    row_.resize(4 * static_cast<std::size_t>(width));
    sc_core::sc_time there = sc_core::sc_time_stamp();
    for (std::size_t at = 0; at < row_.size(); at += config_.request_bytes) {
        const auto bytes = static_cast<unsigned int>(
            std::min<std::size_t>(config_.request_bytes, row_.size() - at));
        tlm::tlm_generic_payload payload;
        set_access(payload, tlm::TLM_READ_COMMAND, address + at, row_.data() + at, bytes);
        payload.set_extension(&info_);
        sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
        out->b_transport(payload, delay);
        payload.clear_extension(&info_);
        there = std::max(there, sc_core::sc_time_stamp() + delay);
        stats_.bytes += bytes;
        stats_.errors += payload.is_response_error() ? 1 : 0;
    }
    return there;
}

} // namespace degs::sim
