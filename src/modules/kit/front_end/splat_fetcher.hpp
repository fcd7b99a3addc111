// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/kit/front_end/chunk_writer.hpp"
#include "modules/kit/front_end/reuse_cache.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/sram_ports.hpp"
#include "modules/kit/job/traffic.hpp"
#include "stats/statistics.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// Streams the splat records of sorted lists from memory to the rasterisation, in order, a chunk
/// at a time. Fetching stops when the tile is cancelled: requested records still arrive, the rest
/// of the list is never read.
class SplatFetcher : public sc_core::sc_module {
public:
    struct Config {
        int chunk = 16;           ///< splat records per request and hand-over
        int chunks_in_flight = 8; ///< record requests outstanding
        /// Ports of the readers' buffer, whose section has the keys: a chunk is written before the
        /// next.
        BankedSramPorts splat_ports;
        std::size_t chunks = 0; ///< places for chunks; 0: those of the rings to the readers
        bool reads = true;      ///< false: a SplatSupply reads the records that it asks for
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        Cycle busy = 0;
        std::uint64_t records = 0, records_cancelled = 0;
        void describe(StatsVisitor& v) const {
            v.count("records", records, "records", "Splat records fetched.");
            v.count("records_cancelled", records_cancelled, "records",
                    "Splat records not fetched because their tile was finished.");
        }
    };

    FifoPort<SortedRun> sorted;                   ///< until kNoTile
    FifoPort<TileNumber> cancel;                  ///< from the Tile Monitor
    sc_core::sc_vector<FifoPort<SplatChunk>> out; ///< each reader gets the whole stream
    /// To the Tile Dispatcher: the readers have been handed the last chunk of the tile before.
    /// Empty unless tiles are granted.
    sc_core::sc_vector<FifoPort<TileRequest>> request;
    /// One per reader if there are config.chunks: a chunk has left its place.
    sc_core::sc_vector<FifoPort<ChunkReleased>> released;
    MemoryPort records;

    /// `instant`: records arrive as soon as the readers have room for them, without memory; see
    /// BuildOptions. `granted`: tiles come one by one on request, and a last chunk of kNoTile ends
    /// the stream for the readers, which cannot know their last tile. `cache`: records that it has
    /// are not read; null without one.
    SplatFetcher(const sc_core::sc_module_name& name, const Config& config,
                 const TrafficConfig& traffic, const Timebase& time, RenderJob& job,
                 std::size_t readers, bool instant, bool granted = false,
                 ReuseCache* cache = nullptr);

    const Stats& stats() const { return stats_; }

private:
    void end_of_elaboration() override;
    void run();
    SortedRun next_run();
    void fetch(const SortedRun& run);
    void emit(const SplatChunk& chunk, const Completion& ready);
    bool cancelled(TileNumber number);
    Completion read(const JobTile& tile, const SplatChunk& chunk);

    Config config_;
    TrafficConfig traffic_;
    RenderJob& job_;
    bool instant_, granted_;
    ReuseCache* cache_;
    Process self_;
    ChunkWriter writer_;
    TileNumber cancelled_before_ = 0;  // tiles below this number are cancelled or over
    TileNumber skipped_ = kNoTile;     // tile whose last chunk its readers have had
    std::uint64_t done_ = 0;           // entries of the tile being fetched
    std::vector<Completion> answered_; // ring of completion dates of the latest requests
    std::uint64_t requests_ = 0;
    Stats stats_;
};

} // namespace degs
