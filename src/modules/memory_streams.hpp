// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "modules/accelerator_result.hpp"
#include "modules/main_memory.hpp"
#include "modules/memory_gateway.hpp"
#include "modules/render_engine.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// The memory of an accelerator and who asks it for what. Every port is an initiator of its own;
/// ports that carry the same kind of record share the name of their stream in reports.
class MemoryStreams {
public:
    /// What one initiator has transferred.
    struct Traffic {
        std::uint64_t reads = 0, writes = 0;
        std::uint64_t bytes_read = 0, bytes_written = 0; ///< as occupied on the bus
    };

    /// Initiators are numbered, and ties in time resolved, in the order of these calls.
    void connect(MemoryPort& port, const char* stream) {
        ports_.push_back(&port);
        names_.push_back(stream);
    }
    /// Elaborates the memory for all connected ports, or binds them to the gateway of `options`.
    /// With arrays alone neither latency nor bandwidth count.
    void build(const char* name, const MainMemoryConfig& config, const Timebase& time,
               const BuildOptions& options);

    /// What an initiator reads or writes; index = initiator.
    const std::vector<const char*>& names() const { return names_; }
    Traffic traffic(std::size_t initiator) const;
    Traffic total() const;
    /// Nanoseconds in which the data bus, or the mean channel, was occupied.
    double busy_ns() const;
    /// Fills streams, peak and utilisation; the cycles of `result` must be known.
    void collect(AcceleratorResult& result) const;

private:
    std::vector<MemoryPort*> ports_;
    std::vector<const char*> names_;
    double peak_gb_per_s_ = 0;
    // One of them.
    std::unique_ptr<Memory> bus_;
    std::unique_ptr<dram::Lpddr5> lpddr5_;
    MemoryGateway* gateway_ = nullptr;
};

} // namespace degs
