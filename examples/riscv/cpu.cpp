// SPDX-License-Identifier: Apache-2.0
#include "cpu.hpp"

#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "elf.hpp"

namespace {

const char* words_of(std::uint32_t cause) {
    switch (cause) {
    case rv32::kMisalignedFetch:
        return "a jump to a misaligned address";
    case rv32::kFetchFault:
        return "no memory to execute";
    case rv32::kIllegalInstruction:
        return "an illegal instruction";
    case rv32::kBreakpoint:
        return "a breakpoint";
    case rv32::kMisalignedLoad:
    case rv32::kMisalignedStore:
        return "a misaligned access";
    case rv32::kLoadFault:
    case rv32::kStoreFault:
        return "an access that nobody answers";
    case rv32::kMachineCall:
        return "a call of the environment";
    default:
        return "an interrupt";
    }
}

std::string fault_of(const rv32::Core& core) {
    std::uint32_t cause = 0, place = 0;
    core.read_csr(rv32::kMcause, cause);
    core.read_csr(rv32::kMepc, place);
    std::array<char, 64> where{};
    std::snprintf(where.data(), where.size(), " (mcause 0x%x) at 0x%08x", cause, place);
    return words_of(cause) + std::string(where.data()) + ", and no trap vector is set";
}

} // namespace

Firmware load_firmware(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!std::filesystem::is_regular_file(file) || !in) {
        throw std::runtime_error(file + " is no file that can be read.");
    }
    const std::vector<unsigned char> elf(std::istreambuf_iterator<char>(in), {});
    const rv32::Program program = rv32::parse_elf(elf, file);
    return {rv32::memory_image(program, Cpu::kMemoryBytes, file), program.entry};
}

Cpu::Cpu(const sc_core::sc_module_name& name, const Firmware& firmware,
         const sc_core::sc_time& period)
    : sc_module(name), memory_(firmware.memory), core_(*this, firmware.entry), period_(period) {
    if (period == sc_core::SC_ZERO_TIME) {
        throw std::runtime_error(std::string(this->name()) +
                                 ": an instruction takes no time; the period must be at least the "
                                 "time resolution, " +
                                 sc_core::sc_get_time_resolution().to_string() + ".");
    }
    memory_.resize(kMemoryBytes);
    SC_THREAD(run);
}

void Cpu::run() {
    for (;;) {
        core_.set_external_interrupt(irq.read());
        if (core_.waiting()) {
            wait(irq.value_changed_event());
            continue;
        }
        core_.step();
        if (core_.trapped_without_vector()) {
            fault_ = fault_of(core_);
            return;
        }
        wait(period_);
    }
}

bool Cpu::fetch(std::uint32_t address, std::uint32_t& word) {
    return address < kMemoryBytes && load(address, 4, word);
}

bool Cpu::load(std::uint32_t address, unsigned bytes, std::uint32_t& value) {
    value = 0;
    if (address >= kMemoryBytes) {
        return transport(tlm::TLM_READ_COMMAND, address, bytes, value);
    }
    std::memcpy(&value, &memory_[address], bytes);
    return true;
}

bool Cpu::store(std::uint32_t address, unsigned bytes, std::uint32_t value) {
    if (address >= kMemoryBytes) {
        return transport(tlm::TLM_WRITE_COMMAND, address, bytes, value);
    }
    std::memcpy(&memory_[address], &value, bytes);
    return true;
}

bool Cpu::transport(tlm::tlm_command command, std::uint32_t address, unsigned bytes,
                    std::uint32_t& value) {
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
