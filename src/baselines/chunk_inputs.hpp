// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <systemc>

#include "modules/messages.hpp"
#include "tlm/dated_fifo.hpp"

namespace degs {

/// The rings through which an array gets its tiles' splats, tile t on ring t modulo their number.
/// Chunks that still come for a tile that has stopped are dropped whenever the array looks here, so
/// that it can work on tiles from other rings in the meantime.
class ChunkInputs {
public:
    using Ports = sc_core::sc_vector<FifoPort<SplatChunk>>;

    /// `self` is the array's process; both must outlive this.
    ChunkInputs(Process& self, Ports& ports);

    DatedFifo<SplatChunk>& of(TileNumber tile) { return ports_[tile % ports_.size()].ring(); }
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
    void discard_arrived();
    Cycle next_arrival(FifoBase* wanted, Cycle limit);

    Process& self_;
    Ports& ports_;
    std::vector<bool> stopped_; // per port: the last chunk of a stopped tile is still to come
    int stopped_count_ = 0;
    std::vector<FifoBase*> watched_;
    std::uint64_t discarded_ = 0;
};

} // namespace degs
