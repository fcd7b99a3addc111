// SPDX-License-Identifier: Apache-2.0
#include "flat_memory.hpp"

#include <cstring>

FlatMemory::FlatMemory(const sc_core::sc_module_name& name, std::uint64_t bytes)
    : sc_module(name), bytes_(bytes) {
    in.register_b_transport(this, &FlatMemory::transport);
    in.register_transport_dbg(this, &FlatMemory::move);
}

void FlatMemory::transport(int initiator, Payload& payload, sc_core::sc_time& delay) {
    delay += sc_core::sc_time(80, sc_core::SC_NS);
    payload.set_response_status(move(initiator, payload) != 0 ? tlm::TLM_OK_RESPONSE
                                                              : tlm::TLM_ADDRESS_ERROR_RESPONSE);
}

unsigned FlatMemory::move(int, Payload& payload) {
    const std::uint64_t at = payload.get_address();
    if (at > bytes_.size() || payload.get_data_length() > bytes_.size() - at) {
        return 0;
    }
    unsigned char* const here = bytes_.data() + at;
    std::memcpy(payload.is_read() ? payload.get_data_ptr() : here,
                payload.is_read() ? here : payload.get_data_ptr(), payload.get_data_length());
    return payload.get_data_length();
}
