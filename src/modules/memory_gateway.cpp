// SPDX-License-Identifier: Apache-2.0
#include "modules/memory_gateway.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace degs {
namespace {

// Streams whose bytes are the scene; all others carry what the accelerator itself has written.
bool is_scene(std::string_view stream) {
    constexpr std::array<std::string_view, 4> kNames{"geometry", "sh", "means", "shapes"};
    return std::find(kNames.begin(), kNames.end(), stream) != kNames.end();
}

} // namespace

void MemoryGateway::connect(const std::vector<MemoryPort*>& ports,
                            const std::vector<const char*>& streams) {
    in_.init(ports.size());
    stats_.resize(ports.size());
    for (std::size_t i = 0; i < ports.size(); ++i) {
        in_[i].register_b_transport(this, &MemoryGateway::transport, static_cast<int>(i));
        in_[i].register_transport_dbg(this, &MemoryGateway::debug, static_cast<int>(i));
        ports[i]->out.bind(in_[i]);
        if (scene_ && is_scene(streams[i])) {
            ports[i]->observe_reads(scene_);
        }
    }
}

void MemoryGateway::transport(int port, tlm::tlm_generic_payload& payload,
                              sc_core::sc_time& delay) {
    out->b_transport(payload, delay);
    Stats& stats = stats_[static_cast<std::size_t>(port)];
    (payload.is_read() ? stats.reads : stats.writes)++;
    (payload.is_read() ? stats.bytes_read : stats.bytes_written) += payload.get_data_length();
    if (payload.is_response_error()) {
        first_error_ = errors_++ == 0 ? payload.get_response_status() : first_error_;
        payload.set_response_status(tlm::TLM_OK_RESPONSE);
    }
}

unsigned int MemoryGateway::debug(int /*port*/, tlm::tlm_generic_payload& payload) {
    return out->transport_dbg(payload);
}

} // namespace degs
