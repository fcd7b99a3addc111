// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_initiator_socket.h>

#include "tlm/memory.hpp"
#include "tlm/process.hpp"

namespace degs {

/// One stream's way to memory: a TLM-2.0 initiator socket used from dated processes. Works with any
/// LT target. One payload is reused for all accesses, since b_transport blocks.
class MemoryPort : public sc_core::sc_module {
public:
    tlm_utils::simple_initiator_socket<MemoryPort> out;

    MemoryPort(const sc_core::sc_module_name& name, const Timebase& time)
        : sc_core::sc_module(name), out("out"), clock_(&time.clock) {}

    /// Reads or writes `bytes` whose values the model does not keep. Issued at the process's local
    /// date, which does not move; returns the date at which the transfer is complete.
    Cycle read(Process& process, std::uint64_t address, std::uint64_t bytes) {
        return access(process, tlm::TLM_READ_COMMAND, address, nullptr, bytes);
    }
    Cycle write(Process& process, std::uint64_t address, std::uint64_t bytes) {
        return access(process, tlm::TLM_WRITE_COMMAND, address, nullptr, bytes);
    }
    /// Writes real bytes.
    Cycle write(Process& process, std::uint64_t address, const std::vector<unsigned char>& data) {
        return access(process, tlm::TLM_WRITE_COMMAND, address,
                      const_cast<unsigned char*>(data.data()), data.size());
    }

    /// Called with the bytes of every read, which then really come from the memory. For memories
    /// that hold what is read; before the simulation starts.
    using Observer =
        std::function<void(std::uint64_t address, const unsigned char* data, std::uint64_t bytes)>;
    void observe_reads(Observer observer) { observer_ = std::move(observer); }

    /// Puts real bytes there without taking time (debug transport). Throws std::runtime_error if
    /// the memory takes fewer.
    void poke(std::uint64_t address, const std::vector<unsigned char>& data);

private:
    Cycle access(Process& process, tlm::tlm_command command, std::uint64_t address,
                 unsigned char* data, std::uint64_t bytes);

    const ClockDomain* clock_;
    std::vector<unsigned char> scratch_;
    TimingOnly timing_only_;
    Observer observer_;
};

} // namespace degs
