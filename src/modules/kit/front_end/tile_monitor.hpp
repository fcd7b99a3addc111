// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "config/config.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"

namespace degs {

/// Cancels the rest of a tile's list upstream once every array slice has reported that all its
/// pixels have ended. The paper describes feedback to the Issue Banks only; stopping the fetch is
/// our addition [assumed]. Splat Fetchers and Slicing Units sample it between chunks of splats.
class TileMonitor : public sc_core::sc_module {
public:
    struct Config {
        bool cancel = true;     ///< false: paper-literal, the list is parsed to its end
        int latency_cycles = 8; ///< last report to the fetchers
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        std::uint64_t tiles = 0, tiles_cancelled = 0;
    };

    sc_core::sc_vector<FifoPort<SliceReport>> in; ///< one per array slice
    sc_core::sc_vector<FifoPort<TileNumber>> out; ///< one per fetcher

    /// `granted`: the slices work on tiles handed to them one by one, ascending, until kNoTile;
    /// else on all tiles of the job.
    TileMonitor(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
                const RenderJob& job, int slices, std::size_t listeners, bool granted = false);

    const Stats& stats() const { return stats_; }

private:
    void end_of_elaboration() override;
    void run();
    /// A tile that some slices have reported.
    struct Watched {
        TileNumber number;
        std::size_t reports;
        bool all_ended; ///< in all slices that have reported
    };
    bool take_reports();
    Watched& watched(TileNumber number);
    void end_tile(const Watched& tile);

    Config config_;
    const RenderJob& job_;
    bool granted_;
    Process self_;
    std::vector<Watched> watched_;
    Stats stats_;
};

} // namespace degs
