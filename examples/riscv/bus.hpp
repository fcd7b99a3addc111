// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <systemc>
#include <tlm_utils/multi_passthrough_target_socket.h>
#include <tlm_utils/simple_initiator_socket.h>

/// A bus without time of its own, the core's RAM (no wait states), the memory that core and
/// accelerator share (80 ns for an access), a console and a register that ends the simulation.
/// firmware/map.h has the addresses.
class Bus : public sc_core::sc_module {
public:
    using Payload = tlm::tlm_generic_payload;
    tlm_utils::multi_passthrough_target_socket<Bus> in{"in"};
    tlm_utils::simple_initiator_socket<Bus> registers{"registers"};

    explicit Bus(const sc_core::sc_module_name& name);
    /// The address of a copy of `bytes` in new shared memory; a multiple of 4096.
    std::uint32_t add(const std::vector<unsigned char>& bytes);
    /// Replaces bytes of the shared memory.
    void put(std::uint32_t address, const void* bytes, std::size_t count);
    bool ended() const { return ended_; } ///< whether the firmware wrote EXIT
    std::uint32_t status() const { return status_; }

private:
    void transport(int initiator, Payload& payload, sc_core::sc_time& delay);
    unsigned move(int initiator, Payload& payload);
    void write_device(Payload& payload);

    std::vector<unsigned char> ram_, memory_;
    bool ended_ = false;
    std::uint32_t status_ = 0;
};
