// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/kit/front_end/sorter_tiles.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/traffic.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// Reads the lists of its tiles from memory, one ahead of the sorter. The lists of a frame are in
/// memory when its token has come.
class ListLoader : public sc_core::sc_module {
public:
    FifoPort<std::uint32_t> start; ///< frame tokens from the binner
    FifoPort<TileNumber> out;      ///< tiles whose lists have been read
    MemoryPort lists;

    ListLoader(const sc_core::sc_module_name& name, const TrafficConfig& traffic,
               const Timebase& time, const RenderJob& job, const SorterTiles& tiles);

private:
    void end_of_elaboration() override;
    void run();

    TrafficConfig traffic_;
    const RenderJob& job_;
    SorterTiles tiles_;
    Process self_;
};

} // namespace degs
