// SPDX-License-Identifier: Apache-2.0
#include "cpu.hpp"

#include <cstring>

void Cpu::run() {
    for (;;) {
        core_.set_external_interrupt(irq.read());
        if (core_.waiting()) {
            wait(irq.value_changed_event());
            continue;
        }
        core_.step();
        wait(period_);
    }
}

bool Cpu::fetch(std::uint32_t address, std::uint32_t& word) {
    return from_code(address, 4, word);
}

bool Cpu::load(std::uint32_t address, unsigned bytes, std::uint32_t& value) {
    return from_code(address, bytes, value) ||
           transport(tlm::TLM_READ_COMMAND, address, bytes, value);
}

bool Cpu::store(std::uint32_t address, unsigned bytes, std::uint32_t value) {
    return transport(tlm::TLM_WRITE_COMMAND, address, bytes, value);
}

bool Cpu::from_code(std::uint32_t address, unsigned bytes, std::uint32_t& value) const {
    if (address >= code_.size() || bytes > code_.size() - address) {
        return false;
    }
    value = 0;
    std::memcpy(&value, &code_[address], bytes);
    return true;
}

bool Cpu::transport(tlm::tlm_command command, std::uint32_t address, unsigned bytes,
                    std::uint32_t& value) {
    if (command == tlm::TLM_READ_COMMAND) {
        value = 0;
    }
    tlm::tlm_generic_payload payload; // the bytes of a little-endian host
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(reinterpret_cast<unsigned char*>(&value));
    payload.set_data_length(bytes);
    payload.set_streaming_width(bytes);
    sc_core::sc_time delay;
    out->b_transport(payload, delay);
    wait(delay);
    return payload.is_response_ok();
}
