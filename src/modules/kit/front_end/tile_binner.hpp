// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "modules/kit/front_end/list_changes.hpp"
#include "modules/kit/front_end/list_writes.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/traffic.hpp"
#include "stats/statistics.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// Collects the Projection Units' results in scene order, writes splat records and tile-list
/// entries to memory, and lets sorting start when the frame's lists are complete. The paper does
/// not name this block, but some unit has to write the lists. Where they are not a stream, entries
/// wait in half of a buffer until it is full, and go to the ends of their lists while the other
/// half fills; ends of lists that do not fit the chip are read from memory before and written back.
/// Views that are read together take turns chunk by chunk; each has its share of both memories.
class TileBinner : public sc_core::sc_module {
public:
    struct Config {
        int pairs_per_cycle = 8;  ///< tile-list entries written per cycle
        int writes_in_flight = 8; ///< chunk writes not yet acknowledged
        ListWriting entries = ListWriting::Stream;
        int buffer_bytes = 8192; ///< entries that wait to be combined
        int head_bytes = 16384;  ///< ends of lists on the chip, those of the first tiles
        bool keep_lists = false; ///< only what is new in a frame is written
        void describe(ConfigVisitor& visitor);
        /// Entries per cycle beyond those of the binner that published rows contain [assumed].
        int more_pairs() const {
            constexpr int kPublished = 8;
            return std::max(0, pairs_per_cycle - kPublished);
        }
        /// Bytes of SRAM: none for a stream.
        int sram_bytes() const;
    };
    struct Stats {
        Cycle busy = 0;
        // Written, unless entries are a stream.
        std::uint64_t entries = 0, groups = 0, bursts = 0, far_heads = 0;
        void describe(StatsVisitor& v) const {
            v.count("entries", entries, "entries", "List entries that were written.");
            v.count("groups", groups, "groups", "Groups of entries of one tile in the buffer.");
            v.count("bursts", bursts, "bursts", "Bursts that they were written in.");
            v.count("far_heads", far_heads, "words",
                    "Ends of lists read from memory and written back.");
        }
        std::uint64_t pairs = 0; ///< of tiles and splats, of all chunks
        Cycle frame_binned = 0;  ///< date at which the last frame's lists were complete
    };

    sc_core::sc_vector<FifoPort<ProjectedChunk>> in; ///< one per Projection Unit
    sc_core::sc_vector<FifoPort<std::uint32_t>> out; ///< frames whose lists are complete
    MemoryPort splats;
    MemoryPort lists;
    std::unique_ptr<MemoryPort> heads; ///< null where entries are a stream

    TileBinner(const sc_core::sc_module_name& name, const Config& config,
               const TrafficConfig& traffic, const Timebase& time, const RenderJob& job,
               ListChanges& changes, int chunk, std::size_t inputs, std::size_t outputs);

    const Stats& stats() const { return stats_; }
    const Config& config() const { return config_; }
    /// Bytes read from and written to its SRAM: entries, and the ends of the lists of groups.
    std::uint64_t sram_bytes_moved() const;
    /// Dates at which the lists of each frame were complete.
    const KeptList<Cycle>& frames_binned() const { return frames_binned_; }

private:
    void end_of_elaboration() override;
    /// A view whose lists are being made.
    struct View {
        MemoryMap map;
        ListWrites writes;
        std::uint64_t waiting = 0; ///< entries in the buffer
    };
    void run();
    void begin(std::uint32_t frame, View& view);
    void bin(const ProjectedChunk& chunk, View& view);
    Completion write_splats(const ProjectedChunk& chunk, const MemoryMap& map);
    /// Takes the entries of a chunk, and flushes the buffer as often as it becomes full.
    void take_entries(const ProjectedChunk& chunk, View& view);
    void flush(std::uint64_t entries, View& view);
    /// Entries that chunks of the frame write before a visible Gaussian.
    std::uint64_t entries_before(std::uint32_t frame, const View& view,
                                 std::uint32_t visible) const {
        return follows_entries_ ? view.writes.entries_before(visible)
                                : job_.pairs_before(frame, visible);
    }
    void acknowledge(const Completion& write);

    Config config_;
    TrafficConfig traffic_;
    const RenderJob& job_;
    ListChanges& changes_;
    std::vector<View> views_;              // that are read together
    bool follows_entries_;                 // other than that all are written, as a stream
    std::vector<bool> written_;            // of a frame's entries
    Cycle drained_ = 0;                    // when the other half of the buffer is empty
    std::vector<std::uint32_t> far_heads_; // tiles of a flush whose heads are in memory
    std::uint64_t chunk_;                  // Gaussians per chunk
    Process self_;
    std::vector<Completion> acknowledged_; // ring of completion dates of the latest writes
    std::uint64_t writes_ = 0;
    Completion last_write_;
    KeptList<Cycle> frames_binned_; // from RenderJob::first_dated() on
    Stats stats_;
};

} // namespace degs
