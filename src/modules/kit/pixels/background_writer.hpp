// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>
#include <vector>

#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/traffic.hpp"
#include "tlm/memory_port.hpp"

namespace degs {

/// Writes the pixels of the tiles that list no splat: they never enter the pipeline. That a tile is
/// one of them is known when the lists of its frame are complete. One posted write leaves every
/// `cycles_per_write` cycles: a row of pixels of neighbouring background tiles, or all their rows
/// where they are as wide as the image.
class BackgroundWriter : public sc_core::sc_module {
public:
    struct Stats {
        Cycle finished = 0; ///< date at which the last background pixel was in memory
    };

    /// Frames whose lists are complete; empty if `instant`.
    sc_core::sc_vector<FifoPort<std::uint32_t>> listed;
    /// Sends the frame once its background is in memory; empty if nobody waits for it.
    sc_core::sc_vector<FifoPort<std::uint32_t>> frame_done;
    MemoryPort frame_buffer;

    /// `instant`: nothing is written, see BuildOptions; unless it reports, it does not run.
    BackgroundWriter(const sc_core::sc_module_name& name, const TrafficConfig& traffic,
                     const Timebase& time, RenderJob& job, int cycles_per_write, bool reports,
                     bool instant);

    const Stats& stats() const { return stats_; }
    /// Dates at which each frame's background was in memory.
    const KeptList<Cycle>& frames_written() const { return frames_written_; }

private:
    void end_of_elaboration() override;
    void run();
    Completion write_frame(std::uint32_t frame);
    Completion write_run(std::uint32_t frame, int tile_row, int begin, int end);

    TrafficConfig traffic_;
    RenderJob& job_;
    Cycle cycles_per_write_;
    bool instant_;
    Process self_;
    Cycle next_write_ = 0;           // no write leaves before this
    KeptList<Cycle> frames_written_; // from RenderJob::first_dated() on
    Stats stats_;
};

} // namespace degs
