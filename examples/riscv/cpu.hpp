// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <systemc>
#include <tlm_utils/simple_initiator_socket.h>

#include "rv32.hpp"

/// A core as a TLM-2.0 initiator: an instruction takes one period of its clock, and every access to
/// `out` what its target annotates. It is not decoupled: kernel time is the core's time. Code comes
/// from `code`, a ROM of the core at address 0, and takes no access.
class Cpu : public sc_core::sc_module, private rv32::Memory {
public:
    tlm_utils::simple_initiator_socket<Cpu> out{"out"};
    sc_core::sc_in<bool> irq{"irq"};

    SC_HAS_PROCESS(Cpu);
    Cpu(const sc_core::sc_module_name& name, std::vector<unsigned char> code,
        const sc_core::sc_time& period)
        : sc_module(name), code_(std::move(code)), period_(period) {
        SC_THREAD(run);
    }
    std::uint64_t instructions() const { return core_.retired(); }

private:
    void run();
    bool fetch(std::uint32_t address, std::uint32_t& word) override;
    bool load(std::uint32_t address, unsigned bytes, std::uint32_t& value) override;
    bool store(std::uint32_t address, unsigned bytes, std::uint32_t value) override;
    bool from_code(std::uint32_t address, unsigned bytes, std::uint32_t& value) const;
    bool transport(tlm::tlm_command command, std::uint32_t address, unsigned bytes,
                   std::uint32_t& value);

    std::vector<unsigned char> code_;
    sc_core::sc_time period_;
    rv32::Core core_{*this};
};
