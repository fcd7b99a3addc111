// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <systemc>

#include "modules/kit/front_end/frames_in_flight.hpp"
#include "modules/kit/front_end/projection_rate.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/traffic.hpp"
#include "modules/kit/job/view_sharing.hpp"
#include "stats/statistics.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// Reads Gaussians, culls and projects them, then reads the SH of the visible ones and shades them
/// (paper Table I, "Projection Unit"); with `traffic.sh: all` it also reads the SH of culled ones.
/// Chunks of the scene go round the units. Three overlapping steps, each with its own date: fetch
/// geometry, project, shade. The views of a frame go through each step chunk by chunk, one view
/// behind the other, with what they share read once. Not modelled: the arithmetic pipeline's depth
/// beyond `latency_cycles`; values come from the shared FrameWorkload.
class ProjectionUnit : public sc_core::sc_module {
public:
    struct Config : ProjectionRate {
        int count = 4;             ///< units
        int chunk = 64;            ///< Gaussians per request and hand-over
        int chunks_in_flight = 4;  ///< geometry requests outstanding per unit
        int chunks_ahead = 4;      ///< of the binner
        int cycles_per_colour = 1; ///< SH evaluation initiation interval
        int latency_cycles = 32;   ///< projection pipeline
        ViewSharing shared_by_views = ViewSharing::Sh;
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        Cycle project_busy = 0, shade_busy = 0;
        std::uint64_t gaussians = 0, visible = 0;
        void describe(StatsVisitor& v) const {
            v.count("gaussians", gaussians, "Gaussians", "Gaussians whose geometry was read.");
            v.count("visible", visible, "Gaussians", "Gaussians that at least one tile lists.");
        }
    };

    MemoryPort geometry;
    MemoryPort sh;
    FifoPort<ProjectedChunk> out;
    /// Numbers of finished frames from the Frame Gate; empty unless frames wait for each other.
    sc_core::sc_vector<FifoPort<std::uint32_t>> frame_free;

    /// `frames_in_flight`: frame f + this many waits for the end of frame f; 0: none waits.
    ProjectionUnit(const sc_core::sc_module_name& name, const Config& config,
                   const TrafficConfig& traffic, const Timebase& time, const RenderJob& job,
                   int index, int frames_in_flight = 0);

    const Stats& stats() const { return stats_; }

private:
    struct Chunk {
        std::uint32_t frame = 0;
        std::uint64_t first = 0, count = 0;
    };
    void end_of_elaboration() override;
    void fetch();
    void project();
    void shade();
    void project_views(const Chunk& chunk);
    ProjectedChunk seen_in(std::uint32_t view, const Chunk& chunk) const;
    /// The views of the chunk, which have been projected, with one read for all of them.
    void hand_over_together(const Chunk& chunk);
    void collect_seen();
    /// The SH of a chunk; if not of all its Gaussians, of those `count`.
    Completion read_sh(const Chunk& chunk, const std::uint32_t* gaussians, std::size_t count);

    Config config_;
    TrafficConfig traffic_;
    const RenderJob& job_;
    int index_;
    FramesInFlight in_flight_;
    std::vector<ProjectedChunk> views_; // of the chunk that is projected
    std::vector<std::uint32_t> seen_;   // Gaussians of it that any view shows
    Process fetcher_, projector_, shader_;
    DatedFifo<Chunk> fetched_;
    DatedFifo<ProjectedChunk> projected_;
    Stats stats_;
};

} // namespace degs
