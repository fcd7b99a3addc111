// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "modules/kit/accelerator/accelerator_result.hpp"
#include "modules/kit/config/main_memory_config.hpp"
#include "tlm/latency_histogram.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// The owner of the bytes of a stream. `Scene`: data that a host has put into memory for the
/// accelerator. `Own`: data that the accelerator itself writes, and may read back.
enum class StreamData { Scene, Own };

/// A kind of record that is read or written. The texts are literals.
struct StreamKind {
    const char* name; ///< key in results
    StreamData data;
    const char* sentence;  ///< who moves what, and when
    bool prepares = false; ///< the first task of a frame waits for some of it, or all
};

/// A stream between the accelerator and its memory. Every stream is an initiator of its own;
/// several may carry the same kind of record.
struct MemoryStream {
    MemoryPort* port;
    StreamKind kind;
    bool urgent = false; ///< the frame that is blended waits for its reads
};

/// The traffic of one initiator.
struct MemoryTraffic {
    std::uint64_t reads = 0, writes = 0;             ///< accesses
    std::uint64_t bytes_read = 0, bytes_written = 0; ///< as they occupied the memory
};

/// The memory of any accelerator: its own, see make_main_memory(), or that of a platform.
class MainMemory {
public:
    MainMemory() = default;
    MainMemory(const MainMemory&) = delete;
    MainMemory& operator=(const MainMemory&) = delete;
    virtual ~MainMemory() = default;

    /// Binds the ports of an accelerator; once, during elaboration. Initiators are numbered, and
    /// ties in time resolved, in this order.
    virtual void connect(const std::vector<MemoryStream>& streams) = 0;

    virtual MemoryTraffic traffic(std::size_t initiator) const = 0;
    /// Peak bandwidth in 1e9 B/s; 0: unlimited, or not known.
    virtual double peak_gb_per_s() const = 0;
    /// From the date of a read to its last byte; nullptr: not measured.
    virtual const LatencyHistogram* read_latency(std::size_t /*initiator*/) const {
        return nullptr;
    }
    /// Fills in the utilization and what only this memory knows; the cycles and the clock of
    /// `result` must be known.
    virtual void collect(AcceleratorResult& /*result*/) const {}
    /// What this memory leaves out, one sentence each, for --explain.
    virtual std::vector<std::string> explain() const = 0;
};

/// The memory that `config` describes. `unlimited`: neither latency nor bandwidth count. `name`,
/// `config` and `time` are used by connect() and must live until then.
std::unique_ptr<MainMemory> make_main_memory(const char* name, const MainMemoryConfig& config,
                                             const Timebase& time, bool unlimited);

} // namespace degs
