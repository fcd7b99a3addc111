// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <systemc>
#include <tlm_utils/simple_target_socket.h>

#include "degs/accelerator.hpp"
#include "degs/riscv_cpu.hpp"
#include "dram/lpddr5.hpp"
#include "sim/soc/address_bus.hpp"
#include "sim/soc/boot_study.hpp"

namespace degs::sim {

/// Two registers of 32 bits for firmware: a word at 0 is a character for the console, one at 4 ends
/// the simulation with this status. Everything else is an address error.
class FirmwarePort : public sc_core::sc_module {
public:
    tlm_utils::simple_target_socket<FirmwarePort> in;

    explicit FirmwarePort(const sc_core::sc_module_name& name);
    const std::string& console() const { return console_; }
    bool ended() const { return ended_; }
    std::uint32_t status() const { return status_; }

private:
    void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);

    std::string console_;
    bool ended_ = false;
    std::uint32_t status_ = 0;
};

/// The platform whose processor boots firmware:
///
///     cpu.out ---------+                +-- accelerator.registers
///     accelerator.mem -+-- AddressBus --+-- FirmwarePort
///                                       +-- Lpddr5, a socket for each initiator
///
/// boot_map() has the addresses. The scene is in memory before time begins.
class BootPlatform : public sc_core::sc_module {
public:
    BootPlatform(const sc_core::sc_module_name& name, const BootRequest& request, const View& view);

    const FirmwarePort& port() const { return port_; }
    const RiscvCpu& cpu() const { return cpu_; }

private:
    void put_into_memory(std::vector<unsigned char> bytes);

    Timebase time_;
    dram::Lpddr5 memory_;
    AddressBus bus_;
    FirmwarePort port_;
    Accelerator accelerator_;
    RiscvCpu cpu_;
    sc_core::sc_signal<bool> irq_;
};

} // namespace degs::sim
