// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/kit/front_end/chunk_writer.hpp"

namespace degs {

/// Takes chunks of splats out of a FIFO of the Splat Supply and writes them to a Gaussian Buffer. A
/// chunk leaves its FIFO when every reader of the buffer has a place for it.
class SplatOutlet : public sc_core::sc_module {
public:
    FifoPort<SplatChunk> in;                      ///< until kNoTile, where tiles are granted
    sc_core::sc_vector<FifoPort<SplatChunk>> out; ///< each reader gets the whole stream
    /// One per reader if there are `places`: a chunk has left its place.
    sc_core::sc_vector<FifoPort<ChunkReleased>> released;
    FifoPort<ChunkReleased> moved; ///< a chunk has left the FIFO

    /// `ports` and `places` of the buffer: see SplatFetcher::Config. `instant`: writing takes no
    /// time if the ports are not limited.
    SplatOutlet(const sc_core::sc_module_name& name, const Timebase& time, std::size_t readers,
                const BankedSramPorts& ports, std::size_t places, bool instant);

private:
    void end_of_elaboration() override;
    void run();

    Process self_;
    ChunkWriter writer_;
};

} // namespace degs
