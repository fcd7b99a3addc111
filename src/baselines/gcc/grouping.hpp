// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <systemc>

#include "baselines/gcc/traffic.hpp"
#include "modules/kit/front_end/frames_in_flight.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/view_sharing.hpp"
#include "stats/statistics.hpp"
#include "tlm/memory_port.hpp"

namespace degs::gcc {

/// How a Gaussian gets into the lists of the views. `Direct`: Stage I appends it to the list of
/// every view that it overlaps. `Regrouped`: groups of the whole image are written first and dealt
/// out to the views in a second pass. With a single view both write its groups once.
enum class Lists { Direct, Regrouped };

/// Stage I of GCC, once per frame: reads nothing but the means of all Gaussians, computes their
/// depth, drops those before the near plane or outside the image, and writes the others' (depth,
/// index) entries into depth-ordered groups, per view if the image has several. Not modelled: how a
/// group's depth range is chosen, and that groups come out more or less full.
///
/// The eyes of a frame share the means: a chunk is read once and grouped for one eye after the
/// other. Stages II and III read what a list names and share nothing. (RenderJob calls the eyes
/// views; in GCC these are parts of an image.)
class Grouping : public sc_core::sc_module {
public:
    struct Config {
        int means_per_cycle = 4;   ///< depth and cull
        int chunk = 256;           ///< means per request
        int chunks_in_flight = 4;  ///< requests outstanding
        int entries_per_cycle = 8; ///< list entries written per cycle
        int writes_in_flight = 8;  ///< requests not yet acknowledged
        Lists lists = Lists::Direct;
        ViewSharing shared_by_views = ViewSharing::Geometry; ///< GCC cannot share more
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        Cycle busy = 0;
        /// What `busy` would be if the other of the two rates had no limit. Reports do not show
        /// them.
        Cycle mean_cycles = 0, entry_cycles = 0;
        std::uint64_t gaussians = 0, entries_written = 0, view_entries = 0;
        void describe(StatsVisitor& v) const {
            v.count("gaussians", gaussians, "Gaussians", "Gaussians whose mean was read.");
            v.count("entries_written", entries_written, "entries",
                    "Entries written to the lists of groups.");
            v.count("view_entries", view_entries, "entries",
                    "Entries of lists that belong to a view.");
        }
    };

    sc_core::sc_vector<FifoPort<std::uint32_t>> out; ///< frames whose lists are complete
    /// Frames whose lists are complete, to all others that wait for these lists.
    sc_core::sc_vector<FifoPort<std::uint32_t>> listed;
    /// Frames that have been written; empty unless frames have to wait for each other.
    sc_core::sc_vector<FifoPort<std::uint32_t>> frame_free;
    MemoryPort means;
    MemoryPort lists;

    /// `frames_in_flight`: frame f + this waits for a message of frame_free; 0: none does.
    /// `readers`: Stages II.
    Grouping(const sc_core::sc_module_name& name, const Config& config, const Traffic& traffic,
             const Timebase& time, const RenderJob& job, int frames_in_flight,
             std::size_t listeners = 0, std::size_t readers = 1);

    const Stats& stats() const { return stats_; }
    /// Dates at which each frame's lists were complete.
    const KeptList<Cycle>& frames_grouped() const { return frames_grouped_; }

private:
    struct Chunk {
        std::uint64_t first = 0, count = 0;
    };
    /// The lists that are being written.
    struct Region {
        std::uint64_t base = 0, entries = 0;
    };
    void end_of_elaboration() override;
    void fetch();
    void group();
    void group_chunk(std::uint32_t frame, const Chunk& chunk);
    void regroup(std::uint32_t f);
    void finish_lists(std::uint32_t f);
    /// True if lists are made per view; false if they are made per group of the whole image.
    bool by_view(const FrameWorkload& frame) const {
        return config_.lists == Lists::Direct || frame.tiles() == 1;
    }
    void write(Region& region, std::uint64_t entries, Cycle least_cycles);

    Config config_;
    Traffic traffic_;
    const RenderJob& job_;
    FramesInFlight in_flight_;
    Process fetcher_, grouper_;
    DatedFifo<Chunk> fetched_;
    std::vector<Completion> acknowledged_; // ring of completion dates of the latest writes
    std::uint64_t writes_ = 0;
    std::vector<Region> regions_; // of each eye whose means are read together
    Completion last_write_;
    KeptList<Cycle> frames_grouped_; // from RenderJob::first_dated() on
    Stats stats_;
};

} // namespace degs::gcc
