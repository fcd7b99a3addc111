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
    if (piece_at(payload.get_address(), payload.get_data_length()) == payload.get_data_length()) {
        out->b_transport(payload, delay);
    } else {
        fold(payload, delay);
    }
    Stats& stats = stats_[static_cast<std::size_t>(port)];
    (payload.is_read() ? stats.reads : stats.writes)++;
    (payload.is_read() ? stats.bytes_read : stats.bytes_written) += payload.get_data_length();
    if (payload.is_response_error()) {
        first_error_ = errors_++ == 0 ? payload.get_response_status() : first_error_;
        payload.set_response_status(tlm::TLM_OK_RESPONSE);
    }
}

// Of an access, up to the end of the region that it starts in.
std::uint64_t MemoryGateway::piece_at(std::uint64_t address, std::uint64_t bytes) const {
    for (const Region& region : regions_) {
        if (address - region.begin < region.bytes) {
            return std::min(bytes, region.bytes - (address - region.begin));
        }
    }
    return bytes;
}

std::uint64_t MemoryGateway::start_of(std::uint64_t address) const {
    const auto home = std::find_if(regions_.begin(), regions_.end(), [&](const Region& region) {
        return address - region.begin < region.bytes;
    });
    return home->begin;
}

// All pieces are issued at the date of the access, which ends with the last of them; the first
// error is the access's.
void MemoryGateway::fold(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
    const std::uint64_t address = payload.get_address();
    const std::uint64_t home = start_of(address);
    unsigned char* const data = payload.get_data_ptr();
    const unsigned int bytes = payload.get_data_length();
    const sc_core::sc_time date = sc_core::sc_time_stamp() + delay;
    sc_core::sc_time done = date;
    tlm::tlm_response_status status = tlm::TLM_OK_RESPONSE;
    std::uint64_t at = address;
    for (std::uint64_t moved = 0; moved != bytes; at = home) {
        const std::uint64_t piece = piece_at(at, bytes - moved);
        const sc_core::sc_time now = sc_core::sc_time_stamp();
        sc_core::sc_time wait = date > now ? date - now : sc_core::SC_ZERO_TIME;
        payload.set_address(at);
        payload.set_data_ptr(data + moved);
        payload.set_data_length(static_cast<unsigned int>(piece));
        payload.set_streaming_width(static_cast<unsigned int>(piece));
        payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
        out->b_transport(payload, wait);
        done = std::max(done, sc_core::sc_time_stamp() + wait);
        status = status == tlm::TLM_OK_RESPONSE ? payload.get_response_status() : status;
        moved += piece;
    }
    payload.set_address(address);
    payload.set_data_ptr(data);
    payload.set_data_length(bytes);
    payload.set_streaming_width(bytes);
    payload.set_response_status(status);
    const sc_core::sc_time now = sc_core::sc_time_stamp();
    delay = done > now ? done - now : sc_core::SC_ZERO_TIME;
}

MemoryGateway::Stats MemoryGateway::total() const {
    Stats sum;
    for (const Stats& each : stats_) {
        sum.reads += each.reads;
        sum.writes += each.writes;
        sum.bytes_read += each.bytes_read;
        sum.bytes_written += each.bytes_written;
    }
    return sum;
}

unsigned int MemoryGateway::debug(int /*port*/, tlm::tlm_generic_payload& payload) {
    return out->transport_dbg(payload);
}

} // namespace degs
