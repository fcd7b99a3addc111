// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "modules/accelerator_result.hpp"
#include "tlm/memory.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// The memory of an accelerator and who asks it for what. Every port is an initiator of its own;
/// ports that carry the same kind of record share the name of their stream in reports.
class MemoryStreams {
public:
    /// Initiators are numbered, and ties in time resolved, in the order of these calls.
    void connect(MemoryPort& port, const char* stream) {
        ports_.push_back(&port);
        names_.push_back(stream);
    }
    /// Elaborates the memory for all connected ports. `unlimited`: neither latency nor bandwidth
    /// count, see BuildOptions.
    void build(const char* name, Memory::Config config, const Timebase& time, bool unlimited);

    const Memory& memory() const { return *memory_; }
    /// What an initiator reads or writes; index = Memory initiator.
    const std::vector<const char*>& names() const { return names_; }
    /// Fills streams, peak and utilisation; the cycles of `result` must be known.
    void collect(AcceleratorResult& result) const;

private:
    std::vector<MemoryPort*> ports_;
    std::vector<const char*> names_;
    double peak_gb_per_s_ = 0;
    std::unique_ptr<Memory> memory_;
};

} // namespace degs
