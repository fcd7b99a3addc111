// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "tlm/has_process.hpp"

namespace degs {

/// Takes the runs of a tile from the sorter until its list is complete, then hands over the list as
/// a whole. It starts on a list only when there is room for it.
class ListCollector : public sc_core::sc_module {
public:
    FifoPort<SortedRun> in;  ///< from a sorter, until kNoTile
    FifoPort<SortedRun> out; ///< one run per tile, then kNoTile

    ListCollector(const sc_core::sc_module_name& name, const Timebase& time, const RenderJob& job)
        : sc_core::sc_module(name), in("in"), out("out"), job_(job), self_(time) {
        DEGS_HAS_PROCESS(ListCollector);
        SC_THREAD(run);
        self_.show(*this);
    }

private:
    void end_of_elaboration() override {
        in->connect_reader(self_);
        out->connect_writer(self_);
    }
    void run() {
        SortedRun list;
        do {
            out->reserve(self_);
            do {
                list = in->get(self_);
            } while (list.tile != kNoTile && list.end != job_.tiles[list.tile].count);
            out->put(self_, list);
        } while (list.tile != kNoTile);
        self_.finish();
    }

    const RenderJob& job_;
    Process self_;
};

} // namespace degs
