// SPDX-License-Identifier: Apache-2.0
#include "degs/riscv_cpu.hpp"

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
        wait(period_);
    }
}

} // namespace degs
