// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/traffic.hpp"
#include "tlm/dated_fifo.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// Collects the Projection Units' results in scene order, writes splat records and tile-list
/// entries to memory, and lets sorting start when the frame's lists are complete. The paper does
/// not name this block, but some unit has to write the lists.
class TileBinner : public sc_core::sc_module {
public:
    struct Config {
        int pairs_per_cycle = 8;  ///< tile-list entries written per cycle
        int writes_in_flight = 8; ///< chunk writes not yet acknowledged
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        Cycle busy = 0;
        Cycle frame_binned = 0; ///< date at which the last frame's lists were complete
    };

    sc_core::sc_vector<FifoPort<ProjectedChunk>> in; ///< one per Projection Unit
    sc_core::sc_vector<FifoPort<std::uint32_t>> out; ///< frames whose lists are complete
    MemoryPort splats;
    MemoryPort lists;

    TileBinner(const sc_core::sc_module_name& name, const Config& config,
               const TrafficConfig& traffic, const Timebase& time, const RenderJob& job, int chunk,
               std::size_t inputs, std::size_t outputs);

    const Stats& stats() const { return stats_; }
    /// Dates at which the lists of each frame were complete.
    const std::vector<Cycle>& frames_binned() const { return frames_binned_; }

private:
    void end_of_elaboration() override;
    void run();
    void bin(const ProjectedChunk& chunk, const MemoryMap& map);

    Config config_;
    TrafficConfig traffic_;
    const RenderJob& job_;
    std::uint64_t chunk_; // Gaussians per chunk
    Process self_;
    std::vector<Completion> acknowledged_; // ring of completion dates of the latest writes
    std::uint64_t writes_ = 0;
    Completion last_write_;
    std::vector<Cycle> frames_binned_;
    Stats stats_;
};

} // namespace degs
