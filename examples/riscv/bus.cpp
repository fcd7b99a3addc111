// SPDX-License-Identifier: Apache-2.0
#include "bus.hpp"

#include <cstdio>
#include <cstring>

#include "map.h"

Bus::Bus(const sc_core::sc_module_name& name, std::size_t initiators)
    : sc_module(name), memory("memory", initiators) {
    in.register_b_transport(this, &Bus::transport);
    in.register_transport_dbg(this, &Bus::debug);
}

void Bus::transport(int initiator, Payload& payload, sc_core::sc_time& delay) {
    const std::uint64_t address = payload.get_address();
    if (address >= BOOT_TABLE) {
        payload.set_address(address - BOOT_TABLE);
        memory[static_cast<std::size_t>(initiator)]->b_transport(payload, delay);
    } else if (address >= CONSOLE) {
        write_device(payload);
    } else if (address >= REGISTERS) {
        payload.set_address(address - REGISTERS);
        registers->b_transport(payload, delay);
    } else {
        payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
    }
    payload.set_address(address);
}

unsigned Bus::debug(int initiator, Payload& payload) {
    const std::uint64_t address = payload.get_address();
    if (address < BOOT_TABLE) {
        return 0;
    }
    payload.set_address(address - BOOT_TABLE);
    const unsigned moved = memory[static_cast<std::size_t>(initiator)]->transport_dbg(payload);
    payload.set_address(address);
    return moved;
}

void Bus::write_device(Payload& payload) {
    const std::uint64_t address = payload.get_address();
    if (!payload.is_write() || payload.get_data_length() != 4 ||
        (address != CONSOLE && address != EXIT)) {
        payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
        return;
    }
    std::uint32_t word = 0;
    std::memcpy(&word, payload.get_data_ptr(), 4);
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
    if (address == CONSOLE) {
        std::putchar(static_cast<unsigned char>(word));
        return;
    }
    ended_ = true;
    status_ = word;
    sc_core::sc_stop();
}
