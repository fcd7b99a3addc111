// SPDX-License-Identifier: Apache-2.0
// Any accelerator on frames made by hand, and what must hold of every run.
#pragma once

#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/modules/degs/accelerator_fixture.hpp"

namespace degs::test {

/// Whether the frames of a job are there from the start, or each when a block first asks for it.
enum class Joining { AtOnce, InTurn };

/// One accelerator with its job. Several may live in one elaboration.
class EngineRun {
public:
    EngineRun(const std::string& name, const AcceleratorConfig& config,
              const std::vector<const FrameWorkload*>& frames, Fidelity fidelity = Fidelity::Exact,
              const BuildOptions& options = {}, int views = 1, Joining joining = Joining::AtOnce)
        : time_{ClockDomain(config.clock_ghz), fidelity},
          job_(joining == Joining::AtOnce ? make_render_job(frames, config, views)
                                          : make_render_job(config, views)),
          pes_(config.pes()), clock_ghz_(config.clock_ghz) {
        EXPECT_EQ(config.problem(), "");
        if (joining == Joining::InTurn) {
            take_in_turn(source_of(frames));
        }
        engine_ = config.build(name.c_str(), time_, job_, options);
    }
    const RenderJob& job() const { return job_; }
    const Image& image(std::size_t frame = 0) const { return job_.images[frame]; }
    AcceleratorResult result() const {
        AcceleratorResult result;
        result.clock_ghz = clock_ghz_;
        engine_->collect(result);
        return result;
    }

    /// The invariants that the engine states itself, slots by window, tiles.
    void expect_sound() const {
        EXPECT_EQ(engine_->finished_tiles(), job_.tiles.size());
        expect_laws(result(), pes_);
    }
    void expect_reference() const { expect_reference_pixels(job_, result().fragments()); }
    /// Every number of the result in words, to compare runs by.
    std::string words() const;
    /// The most frames that were there when another one joined.
    std::size_t most_kept() const { return most_kept_; }

private:
    void take_in_turn(FrameSource source) {
        job_.source = {source.frames, [this, source]() mutable {
                           most_kept_ =
                               std::max(most_kept_, job_.frames.size() - job_.frames.first());
                           return source.take();
                       }};
    }

    Timebase time_;
    RenderJob job_;
    int pes_;
    double clock_ghz_;
    std::size_t most_kept_ = 0;
    std::unique_ptr<RenderEngine> engine_;
};

inline std::string EngineRun::words() const {
    const AcceleratorResult r = result();
    std::ostringstream out;
    const SlotAccount& s = r.slots;
    out << r.cycles << ' ' << r.window.first << '-' << r.window.last << " slots " << s[Slot::Useful]
        << ' ' << s[Slot::Boundary] << ' ' << s[Slot::Terminated] << ' ' << s[Slot::Conflict] << ' '
        << s[Slot::Starved] << ' ' << s[Slot::Blocked] << ' ' << s[Slot::Drain] << '\n';
    for (const FrameDates& frame : r.frames) {
        out << "frame " << frame.preprocessed << ' ' << frame.finished << '\n';
    }
    const auto counts = [&out](const Counters& counters) {
        for (const Counters::Counter& counter : counters) {
            out << ' ' << counter.doc.name << ' ' << counter.value;
        }
        out << '\n';
    };
    for (const StageUse& stage : r.stages) {
        out << stage.name << ' ' << stage.busy_cycles;
        counts(stage.counters);
    }
    for (const BufferUse& buffer : r.buffers) {
        out << buffer.name << ' ' << buffer.high_water << ' ' << buffer.mean_fill << ' '
            << buffer.full_cycles << ' ' << buffer.empty_cycles;
        counts(buffer.counters);
    }
    for (const StreamUse& stream : r.streams) {
        out << stream.name << ' ' << stream.bytes_read << ' ' << stream.bytes_written << ' '
            << stream.requests << '\n';
    }
    out << r.tiles << ' ' << r.background_tiles << ' ' << r.tiles_cancelled << ' '
        << r.memory_utilization << '\n';
    if (r.dram_energy) {
        out << r.row_hit_rate.value_or(0) << ' ' << r.dram_energy->total_nj() << '\n';
    }
    return out.str();
}

} // namespace degs::test
