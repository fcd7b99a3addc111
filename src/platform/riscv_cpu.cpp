// SPDX-License-Identifier: Apache-2.0
#include "degs/riscv_cpu.hpp"

#include <array>
#include <cstdio>
#include <cstring>

#include "degs/error.hpp"
#include "riscv/elf.hpp"
#include "riscv/rv32.hpp"
#include "scene/files/input_file.hpp"
#include "tlm/has_process.hpp"
#include "tlm/set_access.hpp"

namespace degs {

RiscvProgram riscv_program(const std::vector<unsigned char>& elf, const std::string& name) {
    const rv32::Program program = rv32::parse_elf(elf, name);
    return {rv32::memory_image(program, RiscvCpu::kMemoryBytes, name), program.entry};
}

RiscvProgram load_riscv_program(const std::string& file) {
    constexpr std::uint64_t kMostBytes = 64U << 20U; // with symbols for a debugger
    const std::string text = read_text(file, kMostBytes);
    return riscv_program({text.begin(), text.end()}, file);
}

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

/// The core and what it sees: its own memory, and the socket behind it.
class RiscvCpu::Hart : private rv32::Memory {
public:
    Hart(RiscvCpu& cpu, const RiscvProgram& program)
        : cpu_(cpu), memory_(program.memory), core_(*this, program.entry) {
        memory_.resize(kMemoryBytes);
    }
    rv32::Core& core() { return core_; }

private:
    bool fetch(std::uint32_t address, std::uint32_t& word) override {
        return address < kMemoryBytes && load(address, 4, word);
    }
    bool load(std::uint32_t address, unsigned bytes, std::uint32_t& value) override {
        value = 0;
        if (address >= kMemoryBytes) {
            return transport(tlm::TLM_READ_COMMAND, address, bytes, value);
        }
        std::memcpy(&value, &memory_[address], bytes);
        return true;
    }
    bool store(std::uint32_t address, unsigned bytes, std::uint32_t value) override {
        if (address >= kMemoryBytes) {
            return transport(tlm::TLM_WRITE_COMMAND, address, bytes, value);
        }
        std::memcpy(&memory_[address], &value, bytes);
        return true;
    }
    bool transport(tlm::tlm_command command, std::uint32_t address, unsigned bytes,
                   std::uint32_t& value) {
        tlm::tlm_generic_payload payload; // the bytes of a little-endian host
        set_access(payload, command, address, reinterpret_cast<unsigned char*>(&value), bytes);
        sc_core::sc_time delay;
        cpu_.out->b_transport(payload, delay);
        sc_core::wait(delay);
        return payload.is_response_ok();
    }

    RiscvCpu& cpu_;
    std::vector<unsigned char> memory_;
    rv32::Core core_;
};

RiscvCpu::RiscvCpu(const sc_core::sc_module_name& name, const RiscvProgram& program,
                   const sc_core::sc_time& period)
    : sc_core::sc_module(name), out("out"), irq("irq"),
      hart_(std::make_unique<Hart>(*this, program)), period_(period) {
    if (period == sc_core::SC_ZERO_TIME) {
        throw InputError(std::string(this->name()) +
                         ": an instruction takes no time; the period must be at least the time "
                         "resolution, " +
                         sc_core::sc_get_time_resolution().to_string() + ".");
    }
    DEGS_HAS_PROCESS(RiscvCpu);
    SC_THREAD(run);
}

RiscvCpu::~RiscvCpu() = default;

std::uint64_t RiscvCpu::instructions() const {
    return hart_->core().retired();
}

void RiscvCpu::run() {
    rv32::Core& core = hart_->core();
    for (;;) {
        core.set_external_interrupt(irq.read());
        if (core.waiting()) {
            wait(irq.value_changed_event());
            continue;
        }
        core.step();
        if (core.trapped_without_vector()) {
            fault_ = fault_of(core);
            return;
        }
        wait(period_);
    }
}

} // namespace degs
