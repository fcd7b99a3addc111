// SPDX-License-Identifier: Apache-2.0
// An instruction set simulator of RV32IM with Zicsr and machine mode (RISC-V Instruction Set
// Manual, volume I 20191213, chapters 2, 7 and 9; volume II 20211203, chapter 3). It knows no
// SystemC.
#pragma once

#include <array>
#include <cstdint>

namespace rv32 {

/// What mcause holds after an exception; interrupts have kInterrupt set.
enum Cause : std::uint32_t {
    kMisalignedFetch = 0,
    kFetchFault = 1,
    kIllegalInstruction = 2,
    kBreakpoint = 3,
    kMisalignedLoad = 4,
    kLoadFault = 5,
    kMisalignedStore = 6,
    kStoreFault = 7,
    kMachineCall = 11,
    kInterrupt = 0x80000000U,
    kExternalInterrupt = kInterrupt | 11U,
};

enum Csr : std::uint32_t {
    kMstatus = 0x300,
    kMisa = 0x301,
    kMie = 0x304,
    kMtvec = 0x305,
    kMscratch = 0x340,
    kMepc = 0x341,
    kMcause = 0x342,
    kMtval = 0x343,
    kMip = 0x344,
    kMcycle = 0xB00,
    kMinstret = 0xB02,
    kMcycleHigh = 0xB80,
    kMinstretHigh = 0xB82,
    kMvendorid = 0xF11,
    kMhartid = 0xF14,
};
constexpr std::uint32_t kMieBit = 1U << 3U, kMpieBit = 1U << 7U; ///< of mstatus
constexpr std::uint32_t kMppBits = 3U << 11U;                    ///< of mstatus: machine mode
constexpr std::uint32_t kExternalBit = 1U << 11U;                ///< of mie and mip

/// What a core sees of the world. Addresses are multiples of `bytes`, which is 1, 2 or 4. Each
/// function returns whether there is something at the address.
class Memory {
public:
    virtual ~Memory() = default;
    virtual bool fetch(std::uint32_t address, std::uint32_t& word) = 0;
    virtual bool load(std::uint32_t address, unsigned bytes, std::uint32_t& value) = 0;
    virtual bool store(std::uint32_t address, unsigned bytes, std::uint32_t value) = 0;
};

/// One hart in machine mode. Every instruction takes one step; there are no caches, no timer and no
/// compressed instructions.
class Core {
public:
    explicit Core(Memory& memory, std::uint32_t pc = 0) : memory_(memory), pc_(pc) {}

    /// Takes a pending interrupt, if enabled, or executes one instruction, an exception included.
    /// Does nothing while waiting().
    void step();
    /// The level of the external interrupt. A core that waits goes on when it is high and its bit
    /// of mie is set, whether or not mstatus lets it trap (volume II, 3.3.3).
    void set_external_interrupt(bool high);
    /// Whether the core sleeps in a wfi.
    bool waiting() const { return waiting_; }

    std::uint32_t pc() const { return pc_; }
    void set_pc(std::uint32_t pc) { pc_ = pc; }
    /// index: 0 to 31. Register 0 stays 0.
    std::uint32_t x(unsigned index) const { return x_.at(index); }
    void set_x(unsigned index, std::uint32_t value) {
        if (index != 0) {
            x_.at(index) = value;
        }
    }
    /// Reads or writes a register of Csr; false if there is none, or it cannot be written.
    bool read_csr(std::uint32_t csr, std::uint32_t& value) const;
    bool write_csr(std::uint32_t csr, std::uint32_t value);
    /// A trap was taken before the program has written mtvec.
    bool trapped_without_vector() const { return trapped_without_vector_; }
    std::uint64_t retired() const { return retired_; } ///< instructions without exceptions

private:
    struct Fields;
    bool enabled_interrupt() const { return (mip_ & mie_ & kExternalBit) != 0; }
    bool execute(std::uint32_t word);
    bool branch(const Fields& f);
    bool load(const Fields& f);
    bool store(const Fields& f);
    bool arithmetic(const Fields& f);
    bool system(const Fields& f);
    bool change_csr(const Fields& f);
    bool jump(std::uint32_t target);
    bool exception(std::uint32_t cause, std::uint32_t value);
    void enter_trap(std::uint32_t cause, std::uint32_t value);

    Memory& memory_;
    std::array<std::uint32_t, 32> x_{};
    std::uint32_t pc_ = 0, next_pc_ = 0;
    std::uint32_t mstatus_ = kMppBits, mie_ = 0, mip_ = 0, mtvec_ = 0, mscratch_ = 0, mepc_ = 0,
                  mcause_ = 0, mtval_ = 0;
    std::uint64_t cycles_ = 0, retired_ = 0;
    bool waiting_ = false, has_vector_ = false, trapped_without_vector_ = false;
};

} // namespace rv32
