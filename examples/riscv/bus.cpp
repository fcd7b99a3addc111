// SPDX-License-Identifier: Apache-2.0
#include "bus.hpp"

#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "firmware/map.h"

namespace {
constexpr std::uint64_t kRam = 0x10000, kRamBytes = 0x10000, kMemory = BOOT_TABLE, kPage = 4096;
} // namespace

Bus::Bus(const sc_core::sc_module_name& name) : sc_module(name), ram_(kRamBytes) {
    in.register_b_transport(this, &Bus::transport);
    in.register_transport_dbg(this, &Bus::move);
}

std::uint32_t Bus::add(const std::vector<unsigned char>& bytes) {
    const std::uint64_t at = kMemory + memory_.size();
    const std::uint64_t size = (memory_.size() + bytes.size() + kPage - 1) / kPage * kPage;
    if (size > (std::uint64_t{1} << 32U) - kMemory) {
        throw std::runtime_error("The scene does not fit below 4 GiB.");
    }
    memory_.insert(memory_.end(), bytes.begin(), bytes.end());
    memory_.resize(size);
    return static_cast<std::uint32_t>(at);
}

void Bus::put(std::uint32_t address, const void* bytes, std::size_t count) {
    std::memcpy(&memory_.at(address - kMemory), bytes, count);
}

void Bus::transport(int, Payload& payload, sc_core::sc_time& delay) {
    const std::uint64_t address = payload.get_address();
    if (address >= kMemory || (address >= kRam && address < kRam + kRamBytes)) {
        delay += sc_core::sc_time(address >= kMemory ? 80 : 0, sc_core::SC_NS);
        payload.set_response_status(move(0, payload) != 0 ? tlm::TLM_OK_RESPONSE
                                                          : tlm::TLM_ADDRESS_ERROR_RESPONSE);
    } else if (address >= CONSOLE) {
        write_device(payload);
    } else if (address >= REGISTERS) {
        payload.set_address(address - REGISTERS);
        registers->b_transport(payload, delay);
    } else {
        payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
    }
}

unsigned Bus::move(int, Payload& payload) {
    const bool shared = payload.get_address() >= kMemory;
    std::vector<unsigned char>& bytes = shared ? memory_ : ram_;
    const std::uint64_t at = payload.get_address() - (shared ? kMemory : kRam);
    if (at > bytes.size() || payload.get_data_length() > bytes.size() - at) {
        return 0;
    }
    unsigned char* const here = bytes.data() + at;
    std::memcpy(payload.is_read() ? payload.get_data_ptr() : here,
                payload.is_read() ? here : payload.get_data_ptr(), payload.get_data_length());
    return payload.get_data_length();
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
