// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include <systemc>

#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "stats/statistics.hpp"

namespace degs {

/// Hands sorted tiles to engines that each work on a tile of their own: in tile order, the next
/// complete list goes to the engine that asked first; of those that asked in the same cycle, to the
/// one with the lowest index. Engines that wait for the first list of a frame count as asking when
/// it comes, so that a frame does not depend on the one before. One tile is granted per cycle.
class TileDispatcher : public sc_core::sc_module {
public:
    struct Stats {
        std::uint64_t tiles = 0;
        Cycle list_wait = 0, request_wait = 0;
        void describe(StatsVisitor& v) const {
            v.count("tiles", tiles, "tiles", "Tiles granted to an engine.");
            v.count("list_wait_cycles", list_wait, "cycles",
                    "Waiting for the next list to be sorted; an engine may have asked.");
            v.count("request_wait_cycles", request_wait, "cycles",
                    "Waiting for an engine to ask; the next list was sorted.");
        }
    };

    /// Complete lists, from List Collectors; tile t from port t modulo their number.
    sc_core::sc_vector<FifoPort<SortedRun>> in;
    sc_core::sc_vector<FifoPort<TileRequest>> request; ///< one per engine
    sc_core::sc_vector<FifoPort<SortedRun>> out; ///< grants, one per engine; kNoTile at the end

    TileDispatcher(const sc_core::sc_module_name& name, const Timebase& time, const RenderJob& job,
                   std::size_t inputs, std::size_t engines);

    const Stats& stats() const { return stats_; }

private:
    void end_of_elaboration() override;
    void run();
    std::size_t next_engine();
    Cycle asked_at(std::size_t engine) const {
        return std::max(requests_[engine]->head_date(), frame_begun_);
    }

    const RenderJob& job_;
    Process self_;
    std::vector<FifoBase*> requests_;
    Cycle frame_begun_ = 0; // the first list of the present frame was there
    Stats stats_;
};

} // namespace degs
