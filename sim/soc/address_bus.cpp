// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/address_bus.hpp"

namespace degs::sim {
namespace {

std::size_t sockets(std::size_t initiators, const std::vector<AddressBus::Window>& windows) {
    std::size_t count = 0;
    for (const AddressBus::Window& window : windows) {
        count += window.per_initiator ? initiators : 1;
    }
    return count;
}

} // namespace

AddressBus::AddressBus(const sc_core::sc_module_name& name, std::size_t initiators,
                       const std::vector<Window>& windows)
    : sc_core::sc_module(name), in("in", initiators), out("out", sockets(initiators, windows)),
      windows_(windows) {
    std::size_t next = 0;
    for (const Window& window : windows_) {
        first_.push_back(next);
        next += window.per_initiator ? initiators : 1;
    }
    int tag = 0;
    for (auto& socket : in) {
        socket.register_b_transport(this, &AddressBus::transport, tag);
        socket.register_transport_dbg(this, &AddressBus::debug, tag++);
    }
}

const AddressBus::Window* AddressBus::window_of(const tlm::tlm_generic_payload& payload) const {
    for (const Window& window : windows_) {
        const std::uint64_t offset = payload.get_address() - window.begin;
        if (offset < window.bytes && payload.get_data_length() <= window.bytes - offset) {
            return &window;
        }
    }
    return nullptr;
}

void AddressBus::transport(int initiator, tlm::tlm_generic_payload& payload,
                           sc_core::sc_time& delay) {
    const Window* const window = window_of(payload);
    if (window == nullptr) {
        payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
        return;
    }
    const std::uint64_t address = payload.get_address();
    payload.set_address(address - window->begin);
    out[socket_of(window - windows_.data(), initiator)]->b_transport(payload, delay);
    payload.set_address(address);
}

unsigned int AddressBus::debug(int initiator, tlm::tlm_generic_payload& payload) {
    const Window* const window = window_of(payload);
    if (window == nullptr) {
        return 0;
    }
    const std::uint64_t address = payload.get_address();
    payload.set_address(address - window->begin);
    const unsigned int moved =
        out[socket_of(window - windows_.data(), initiator)]->transport_dbg(payload);
    payload.set_address(address);
    return moved;
}

} // namespace degs::sim
