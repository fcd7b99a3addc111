// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <systemc>
#include <tlm_utils/multi_passthrough_target_socket.h>

/// A memory that takes 80 ns for an access of any size, and any number at once.
class FlatMemory : public sc_core::sc_module {
public:
    using Payload = tlm::tlm_generic_payload;
    tlm_utils::multi_passthrough_target_socket<FlatMemory> in{"in"};

    FlatMemory(const sc_core::sc_module_name& name, std::uint64_t bytes);

private:
    void transport(int initiator, Payload& payload, sc_core::sc_time& delay);
    unsigned move(int initiator, Payload& payload);

    std::vector<unsigned char> bytes_;
};
