// SPDX-License-Identifier: Apache-2.0
// A bare TLM-2.0 initiator and a memory with some of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tlm_utils/simple_initiator_socket.h>

#include "tests/tlm/script.hpp"
#include "tlm/memory.hpp"

namespace degs::test {

/// A foreign initiator: a bare TLM-2.0 socket.
struct Initiator : sc_core::sc_module {
    tlm_utils::simple_initiator_socket<Initiator> out;
    explicit Initiator(const sc_core::sc_module_name& name)
        : sc_core::sc_module(name), out("out") {}

    struct Answer {
        sc_core::sc_time done; ///< response, kernel time plus annotated delay
        tlm::tlm_response_status status = tlm::TLM_INCOMPLETE_RESPONSE;
    };
    Answer access(tlm::tlm_command command, std::uint64_t address, unsigned char* data,
                  unsigned int bytes, sc_core::sc_time delay = sc_core::SC_ZERO_TIME,
                  tlm::tlm_extension_base* timing_only = nullptr) {
        tlm::tlm_generic_payload payload;
        fill(payload, command, address, data, bytes);
        TimingOnly extension;
        if (timing_only != nullptr) {
            payload.set_extension(&extension);
        }
        out->b_transport(payload, delay);
        payload.clear_extension(&extension);
        return {sc_core::sc_time_stamp() + delay, payload.get_response_status()};
    }
    static void fill(tlm::tlm_generic_payload& payload, tlm::tlm_command command,
                     std::uint64_t address, unsigned char* data, unsigned int bytes) {
        payload.set_command(command);
        payload.set_address(address);
        payload.set_data_ptr(data);
        payload.set_data_length(bytes);
        payload.set_streaming_width(bytes);
        payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
    }
    unsigned int debug(tlm::tlm_command command, std::uint64_t address, unsigned char* data,
                       unsigned int bytes) {
        tlm::tlm_generic_payload payload;
        fill(payload, command, address, data, bytes);
        return out->transport_dbg(payload);
    }
};

struct MemoryBench {
    Memory memory;
    std::vector<std::unique_ptr<Initiator>> initiators;
    MemoryBench(const Memory::Config& config, std::size_t count, const Timebase& time = {})
        : memory("memory", config, time, count) {
        for (std::size_t i = 0; i < count; ++i) {
            initiators.push_back(
                std::make_unique<Initiator>(("initiator" + std::to_string(i)).c_str()));
            initiators.back()->out.bind(memory.in[i]);
        }
    }
    Initiator& operator[](std::size_t i) { return *initiators[i]; }
};

/// 64 GB/s: one granule per ns.
inline Memory::Config memory_config(double latency_ns = 100, double gb_per_s = 64,
                                    int granule = 64) {
    Memory::Config c;
    c.bandwidth_gb_per_s = gb_per_s;
    c.latency_ns = latency_ns;
    c.access_bytes = granule;
    return c;
}

} // namespace degs::test
