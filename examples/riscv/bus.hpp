// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <systemc>
#include <tlm_utils/multi_passthrough_target_socket.h>
#include <tlm_utils/simple_initiator_socket.h>

/// A bus without time of its own, a console and a register that ends the simulation. map.h of the
/// firmware has the addresses; the memory begins at BOOT_TABLE and has a socket per initiator.
class Bus : public sc_core::sc_module {
public:
    using Payload = tlm::tlm_generic_payload;
    tlm_utils::multi_passthrough_target_socket<Bus> in{"in"}; ///< initiators, in their order
    tlm_utils::simple_initiator_socket<Bus> registers{"registers"};
    sc_core::sc_vector<tlm_utils::simple_initiator_socket<Bus>> memory;

    Bus(const sc_core::sc_module_name& name, std::size_t initiators);
    bool ended() const { return ended_; } ///< whether the firmware wrote EXIT
    std::uint32_t status() const { return status_; }

private:
    void transport(int initiator, Payload& payload, sc_core::sc_time& delay);
    unsigned debug(int initiator, Payload& payload);
    void write_device(Payload& payload);

    bool ended_ = false;
    std::uint32_t status_ = 0;
};
