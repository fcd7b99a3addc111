// SPDX-License-Identifier: Apache-2.0
// Any accelerator on frames made by hand, and what must hold of every run.
#pragma once

#include <cstring>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "modules/render_engine.hpp"
#include "splat/reference_renderer.hpp"
#include "tests/modules/workload_fixture.hpp"

namespace degs::test {

/// One accelerator with its job. Several may live in one elaboration.
class EngineRun {
public:
    EngineRun(const std::string& name, const AcceleratorConfig& config,
              const std::vector<const FrameWorkload*>& frames, Fidelity fidelity = Fidelity::Exact,
              const BuildOptions& options = {})
        : time_{ClockDomain(config.clock_ghz), fidelity}, job_(make_render_job(frames, config)),
          pes_(static_cast<std::uint64_t>(config.pes())) {
        EXPECT_EQ(config.problem(), "");
        engine_ = config.build(name.c_str(), time_, job_, options);
    }
    const RenderJob& job() const { return job_; }
    const Image& image(std::size_t frame = 0) const { return job_.images[frame]; }
    AcceleratorResult result() const {
        AcceleratorResult result;
        engine_->collect(result);
        return result;
    }

    /// The laws that the engine states itself, slots by window, tiles.
    void expect_sound() const {
        const AcceleratorResult r = result();
        EXPECT_EQ(engine_->finished_tiles(), job_.tiles.size());
        EXPECT_EQ(r.slots.total(), r.window.cycles() * pes_);
        EXPECT_EQ(r.hazards, 0U);
        for (const Conservation& c : r.conservation) {
            EXPECT_EQ(c.left, c.right) << c.law;
        }
    }
    /// In double precision with the reference's stop rule: the same pixel updates, and the same
    /// image but for the rounding to float, which may take the last bit either way.
    void expect_reference() const {
        std::uint64_t fragments = 0;
        for (std::size_t f = 0; f < job_.frames.size(); ++f) {
            ReferenceCounts counts;
            const Image reference = render_reference(*job_.frames[f], counts);
            fragments += counts.fragments;
            ASSERT_EQ(image(f).fragments, reference.fragments) << "frame " << f;
            for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
                const double value = reference.rgb[i];
                ASSERT_NEAR(image(f).rgb[i], value, 1e-12 + 0x1p-23 * std::abs(value));
            }
        }
        EXPECT_EQ(result().slots.useful, fragments);
    }
    /// Every number of the result in words, to compare runs by.
    std::string words() const;

private:
    Timebase time_;
    RenderJob job_;
    std::uint64_t pes_;
    std::unique_ptr<RenderEngine> engine_;
};

inline std::string EngineRun::words() const {
    const AcceleratorResult r = result();
    std::ostringstream out;
    const SlotAccount& s = r.slots;
    out << r.cycles << ' ' << r.window.first << '-' << r.window.last << " slots " << s.useful << ' '
        << s.boundary << ' ' << s.terminated << ' ' << s.conflict << ' ' << s.starved << ' '
        << s.blocked << ' ' << s.drain << '\n';
    for (const FrameDates& frame : r.frames) {
        out << "frame " << frame.preprocessed << ' ' << frame.finished << '\n';
    }
    const auto counts = [&out](const Counts& list) {
        for (const auto& [name, value] : list) {
            out << ' ' << name << ' ' << value;
        }
        out << '\n';
    };
    for (const StageUse& stage : r.stages) {
        out << stage.name << ' ' << stage.busy_cycles;
        counts(stage.counts);
    }
    for (const BufferUse& buffer : r.buffers) {
        out << buffer.name << ' ' << buffer.high_water << ' ' << buffer.mean_fill << ' '
            << buffer.full_cycles << ' ' << buffer.empty_cycles;
        counts(buffer.counts);
    }
    for (const StreamUse& stream : r.streams) {
        out << stream.name << ' ' << stream.bytes_read << ' ' << stream.bytes_written << ' '
            << stream.requests << '\n';
    }
    out << r.tiles << ' ' << r.background_tiles << ' ' << r.tiles_cancelled << ' '
        << r.memory_utilization << '\n';
    return out.str();
}

inline bool same_bytes(const Image& a, const Image& b) {
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() &&
               (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
    };
    return same(a.rgb, b.rgb) && same(a.transmittance, b.transmittance) &&
           same(a.fragments, b.fragments);
}

} // namespace degs::test
