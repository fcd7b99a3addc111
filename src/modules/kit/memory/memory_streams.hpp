// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "modules/kit/accelerator/render_engine.hpp"
#include "modules/kit/memory/main_memory.hpp"

namespace degs {

/// The streams of an accelerator and the memory that they go to.
class MemoryStreams {
public:
    using Traffic = MemoryTraffic;

    /// Initiators are numbered, and ties in time resolved, in the order of these calls.
    void connect(MemoryPort& port, const StreamKind& kind) { streams_.push_back({&port, kind}); }
    /// Connects a port for reads that hold up the frame being blended, see ReadPriority.
    void connect_urgent(MemoryPort& port, const StreamKind& kind) {
        streams_.push_back({&port, kind, true});
    }
    /// Elaborates the memory that `config` describes for all connected ports, or binds them to that
    /// of `options`. With arrays alone neither latency nor bandwidth count.
    void build(const char* name, const MainMemoryConfig& config, const Timebase& time,
               const BuildOptions& options);

    std::size_t size() const { return streams_.size(); }
    const char* name(std::size_t initiator) const { return streams_[initiator].kind.name; }
    Traffic traffic(std::size_t initiator) const { return memory_->traffic(initiator); }
    Traffic total() const;
    /// Fills in the results of the memory; the cycles of `result` must be known.
    void collect(AcceleratorResult& result) const;

private:
    void collect_streams(AcceleratorResult& result) const;
    void watch(std::size_t initiator, const Timebase& time);

    std::vector<MemoryStream> streams_;
    std::unique_ptr<MainMemory> own_; // if it is not that of a platform
    MainMemory* memory_ = nullptr;
    std::vector<MemoryTraffic> watched_; // by initiator: what the timeline has so far
};

} // namespace degs
