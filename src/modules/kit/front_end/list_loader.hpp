// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/traffic.hpp"
#include "tlm/dated_fifo.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// Reads the lists of every `stride`-th tile from memory, one ahead of the sorter. The lists of a
/// frame are in memory when its token has come.
class ListLoader : public sc_core::sc_module {
public:
    FifoPort<std::uint32_t> start; ///< frame tokens from the binner
    FifoPort<TileNumber> out;      ///< tiles whose lists have been read
    MemoryPort lists;

    /// Tiles first, first + stride, ...
    ListLoader(const sc_core::sc_module_name& name, const TrafficConfig& traffic,
               const Timebase& time, const RenderJob& job, TileNumber first, TileNumber stride);

private:
    void end_of_elaboration() override;
    void run();

    TrafficConfig traffic_;
    const RenderJob& job_;
    TileNumber first_, stride_;
    Process self_;
};

} // namespace degs
