// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/kit/front_end/sorter_tiles.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "tlm/has_process.hpp"

namespace degs {

/// Replaces projection, binning and sorting when the rasterisation array is simulated alone: the
/// lists of all tiles are in order from the start. Tiles go round the sources.
class ListSource : public sc_core::sc_module {
public:
    FifoPort<SortedRun> sorted;

    ListSource(const sc_core::sc_module_name& name, const Timebase& time, const RenderJob& job,
               TileNumber index, TileNumber sources)
        : sc_core::sc_module(name), sorted("sorted"), job_(job), tiles_(job, index, sources),
          self_(time) {
        DEGS_HAS_PROCESS(ListSource);
        SC_THREAD(run);
        self_.show(*this);
    }

private:
    void end_of_elaboration() override { sorted->connect_writer(self_); }
    void run() {
        while (tiles_.next(self_)) {
            sorted->put(self_, {tiles_.tile(), job_.tiles[tiles_.tile()].count});
        }
        sorted->put(self_, {kNoTile, 0});
        self_.finish();
    }

    const RenderJob& job_;
    SorterTiles tiles_;
    Process self_;
};

} // namespace degs
