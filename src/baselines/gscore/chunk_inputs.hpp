// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <systemc>

#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"

namespace degs::gscore {

/// The rings through which an array gets its tiles' splats. Either all tiles of the job come, tile
/// each on the ring of its sorter, or tiles are granted: they come one by one, ascending, on the
/// only ring, until kNoTile. Chunks that still come for a tile that has stopped are dropped
/// whenever the array looks here, so that it can work on tiles from other rings in the meantime.
class ChunkInputs {
public:
    using Ports = sc_core::sc_vector<FifoPort<SplatChunk>>;

    /// `self` is the array's process; all three must outlive this.
    ChunkInputs(Process& self, Ports& ports, const RenderJob& job, bool granted)
        : self_(self), ports_(ports), job_(job), granted_(granted), stopped_(ports.size(), false) {}

    /// The tile to work on next, at the date at which the array knows of it: a tile of the job from
    /// the start or when it joins, a granted one when its first chunk is there. kNoTile: that was
    /// all.
    TileNumber next_tile();
    DatedFifo<SplatChunk>& of(TileNumber tile) { return ports_[ring_of(tile)].ring(); }
    /// Drops the further chunks of `tile`, whose last chunk has not been taken.
    void stop(TileNumber tile);
    /// Moves the array to the date at which `wanted` has an item it may read, or to `limit`: false
    /// then. An item of a stopped tile does not count. Throws std::logic_error if nothing can come.
    bool wait_for(FifoBase& wanted, Cycle limit);
    /// Waits until nothing more of stopped tiles can come.
    void wait_for_rest();
    /// Splats dropped so far.
    std::uint64_t discarded() const { return discarded_; }

private:
    std::size_t ring_of(TileNumber tile) const { return job_.sorter_of(tile, ports_.size()); }
    TileNumber next_granted();
    TileNumber next_of_job();
    void discard_arrived();
    Cycle next_arrival(FifoBase* wanted, Cycle limit);

    Process& self_;
    Ports& ports_;
    const RenderJob& job_;
    bool granted_;
    TileNumber next_ = 0;       // of the job
    std::vector<bool> stopped_; // per port: the last chunk of a stopped tile is still to come
    int stopped_count_ = 0;
    std::vector<FifoBase*> watched_;
    std::uint64_t discarded_ = 0;
};

} // namespace degs::gscore
