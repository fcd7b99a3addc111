// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <systemc>
#include <tlm_utils/simple_initiator_socket.h>

#include "rv32.hpp"

/// A program for a Cpu, linked to fixed addresses in its memory.
struct Firmware {
    std::vector<unsigned char> memory; ///< from address 0 on; at most Cpu::kMemoryBytes
    std::uint32_t entry = 0;           ///< address of the first instruction, a multiple of 4
};

/// Reads an ELF executable. Throws std::runtime_error, one sentence that names the file, if it
/// cannot be read, is no program for 32-bit RISC-V, does not fit into the core's memory or has no
/// entry.
Firmware load_firmware(const std::string& file);

/// A RISC-V core (RV32IM, Zicsr, machine mode) as a TLM-2.0 initiator. It starts with the
/// simulation, and stops at a trap before the program has written mtvec.
///
/// An instruction takes one period of its clock. Code and data of the program lie in the core's own
/// memory, which has no wait states; every address above goes to `out`, as an LT access of 1, 2 or
/// 4 bytes, and takes what its target annotates. An error response is an access fault. The core is
/// not decoupled: kernel time is its time.
///
/// Not modelled: pipeline, caches, timer, compressed instructions, direct memory access and
/// writable counters.
class Cpu : public sc_core::sc_module, private rv32::Memory {
public:
    static constexpr std::uint32_t kMemoryBytes = 0x20000;

    tlm_utils::simple_initiator_socket<Cpu> out{"out"};
    sc_core::sc_in<bool> irq{"irq"}; ///< the machine external interrupt

#if IEEE_1666_SYSTEMC < 202301L // SystemC 3.0 knows the type of a module
    SC_HAS_PROCESS(Cpu);
#endif
    /// Throws std::runtime_error if the time resolution turns the period into nothing.
    Cpu(const sc_core::sc_module_name& name, const Firmware& firmware,
        const sc_core::sc_time& period);

    /// Instructions that were retired; those that raised an exception are not.
    std::uint64_t instructions() const {
        return core_.retired();
    }
    /// Why the core stands still for ever, as a sentence without its end: "an illegal instruction
    /// (mcause 0x2) at 0x00000000, and no trap vector is set". Empty if it does not: without a
    /// vector a trap would begin at address 0, which traps again or starts the program anew.
    const std::string& fault() const {
        return fault_;
    }

private:
    bool fetch(std::uint32_t address, std::uint32_t& word) override;
    bool load(std::uint32_t address, unsigned bytes, std::uint32_t& value) override;
    bool store(std::uint32_t address, unsigned bytes, std::uint32_t value) override;
    bool transport(tlm::tlm_command command, std::uint32_t address, unsigned bytes,
                   std::uint32_t& value);
    void run();

    std::vector<unsigned char> memory_;
    rv32::Core core_;
    sc_core::sc_time period_;
    std::string fault_;
};
