// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <systemc>
#include <tlm_utils/simple_initiator_socket.h>

namespace degs {

/// A program for a RiscvCpu, linked to fixed addresses in its memory.
struct RiscvProgram {
    std::vector<unsigned char> memory; ///< from address 0 on; at most RiscvCpu::kMemoryBytes
    std::uint32_t entry = 0;           ///< address of the first instruction, a multiple of 4
};

/// Reads an ELF executable. Throws InputError, one sentence that names the file, if it cannot be
/// read, is no program for 32-bit RISC-V, does not fit into the core's memory or has no entry.
RiscvProgram load_riscv_program(const std::string& file);
/// Takes the bytes of such a file; `name` is what errors call it.
RiscvProgram riscv_program(const std::vector<unsigned char>& elf, const std::string& name);

/// A RISC-V core (RV32IM, Zicsr, machine mode) as a TLM-2.0 initiator, for platforms that run bare
/// code. It starts with the simulation, and stops at a trap before the program has
/// written mtvec.
///
/// An instruction takes one period of its clock. Code and data of the program lie in the core's own
/// memory, which has no wait states; every address above goes to `out`, as an LT access of 1, 2 or
/// 4 bytes, and takes what its target annotates. An error response is an access fault. The core is
/// not decoupled: kernel time is its time.
///
/// Not modelled: pipeline, caches, timer, compressed instructions, direct memory access and
/// writable counters.
class RiscvCpu : public sc_core::sc_module {
public:
    static constexpr std::uint32_t kMemoryBytes = 0x20000;

    tlm_utils::simple_initiator_socket<RiscvCpu> out;
    sc_core::sc_in<bool> irq; ///< the machine external interrupt

    /// Throws InputError if the time resolution turns the period into nothing.
    RiscvCpu(const sc_core::sc_module_name& name, const RiscvProgram& program,
             const sc_core::sc_time& period);
    ~RiscvCpu() override;

    /// Instructions that were retired; those that raised an exception are not.
    std::uint64_t instructions() const;
    /// Why the core stands still for ever, as a sentence without its end: "an illegal instruction
    /// (mcause 2) at 0x00000000, and no trap vector is set". Empty if it does not: without a
    /// vector a trap would begin at address 0, which traps again or starts the program anew.
    const std::string& fault() const { return fault_; }

private:
    class Hart;
    void run();

    std::unique_ptr<Hart> hart_;
    sc_core::sc_time period_;
    std::string fault_;
};

} // namespace degs
