// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "modules/degs/supply/record_sharing.hpp"
#include "modules/degs/supply/splat_outlet.hpp"
#include "modules/kit/front_end/splat_fetcher.hpp"
#include "stats/statistics.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// Brings splat records from memory to the Gaussian Buffers of all clusters, for Splat Fetchers
/// that walk the lists and read nothing themselves:
///
///   Splat Fetchers -> Splat Supply -> memory -> bus -> FIFO of each fetcher -> [Gaussian Buffer]
///
/// Requests are taken in the order of their dates, those of equal dates from fetchers in turn.
/// Records that RecordSharing names are read, with one request of memory per chunk and per cycle, a
/// cycle after the choice; every fetcher may have so many chunks outstanding. Complete chunks
/// travel on a bus that all clusters share: whole chunks, to clusters in turn that have one ready
/// and room for it.
///
/// Not modelled: the wires of the bus, the comparators of the windows, and that a record which one
/// cluster reads passes the bus once for all who capture it; each chunk of each cluster passes it.
class SplatSupply : public sc_core::sc_module {
public:
    struct Config {
        int splats_per_cycle = 0;     ///< of the bus; 0: unlimited
        int fifo_splats = 32;         ///< of a cluster
        int request_cycles = 1;       ///< of a fetcher's request, and of the answer
        int multicast_window = 0;     ///< list entries; 0: no multicast
        std::int64_t cache_bytes = 0; ///< of all clusters together; 0: no cache
        void describe(ConfigVisitor& visitor);
        /// False if fetchers read by themselves.
        bool built() const {
            return splats_per_cycle != 0 || multicast_window != 0 || cache_bytes != 0;
        }
        /// Chunks that the FIFO of a fetcher holds, of `fetchers` of a cluster that share its FIFO.
        int fifo_chunks(int fetchers, int chunk) const {
            return std::max(1, fifo_splats / (fetchers * chunk));
        }
        /// Bytes of all FIFOs, windows and the cache.
        std::int64_t bytes(int clusters, int fetchers, int record_bytes) const;
    };
    /// What it stands between.
    struct Shape {
        int clusters = 1;
        int fetchers = 1;              ///< of a cluster
        int readers = 1;               ///< of a fetcher's splats
        SplatFetcher::Config fetching; ///< as the fetchers had it if they read themselves
        bool instant = false;          ///< Array alone: records are there at once
    };
    struct Stats {
        RecordSharing::Stats records;
        std::uint64_t chunks = 0, delivered = 0;
        Cycle bus_busy = 0, bus_wait = 0, room_wait = 0;
        /// Records written to and read from FIFOs, windows and cache. A record that is read
        /// enters the cache if there is one.
        std::uint64_t records_moved() const {
            return 2 * delivered + 2 * records.captured + records.unused + records.hits +
                   records.cached;
        }
        void describe(StatsVisitor& v) const;
    };

    /// Chunks that fetchers ask for, all of cluster 0 first; a last one of kNoTile where tiles are
    /// granted.
    sc_core::sc_vector<FifoPort<SplatChunk>> in;
    /// To each fetcher: the bus has taken its oldest chunk. It may have fetching.chunks_in_flight
    /// chunks that have not been taken.
    sc_core::sc_vector<FifoPort<ChunkReleased>> taken;
    MemoryPort records;

    SplatSupply(const sc_core::sc_module_name& name, const Config& config,
                const TrafficConfig& traffic, const Timebase& time, const RenderJob& job,
                const Shape& shape);

    /// The ports to the Gaussian Buffer of a fetcher.
    SplatOutlet& outlet(std::size_t fetcher) { return *outlets_[fetcher]; }
    const Stats& stats() const {
        stats_.records = sharing_.stats();
        return stats_;
    }

private:
    static constexpr std::size_t kNobody = ~std::size_t{0};
    template <class T>
    using Rings = std::vector<std::unique_ptr<DatedFifo<T>>>;
    /// A fetcher as the bus sees it.
    struct Lane {
        int room = 0; // chunks
        Cycle room_since = 0;
    };

    void build_lanes(const Timebase& time);
    void end_of_elaboration() override;
    void read();
    std::size_t next_request();
    std::size_t first_request();
    Completion answer(std::size_t fetcher, const SplatChunk& chunk);
    void deliver();
    std::size_t next_ready();
    static bool is_there(const FifoBase& ring, Cycle date) {
        return !ring.empty() && ring.head_date() <= date;
    }
    void move(std::size_t fetcher);
    Cycle carry(std::uint32_t splats);
    std::size_t in_turn(std::size_t turn) const {
        return turn % shape_.clusters * shape_.fetchers + turn / shape_.clusters;
    }

    Config config_;
    TrafficConfig traffic_;
    const RenderJob& job_;
    Shape shape_;
    RecordSharing sharing_;
    Process reader_, bus_;
    std::vector<std::unique_ptr<SplatOutlet>> outlets_;
    Rings<SplatChunk> arrived_, fifos_; // by fetcher
    Rings<ChunkReleased> emptied_;      // a FIFO has a place again
    std::vector<Lane> lanes_;
    std::vector<FifoBase*> asked_, waited_; // for the next arrival at the reader and at the bus
    std::size_t asked_turn_ = 0;            // after the fetcher whose request was taken last
    std::size_t turn_ = 0;                  // after the one that the bus served last
    std::uint64_t slot_ = 0;                // the next place of the bus: cycle x rate + splat
    Cycle counted_ = 0;                     // busy cycles of the bus before it are counted
    mutable Stats stats_;
};

} // namespace degs
