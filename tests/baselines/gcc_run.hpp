// SPDX-License-Identifier: Apache-2.0
// Whole GCCs on frames made by hand, and what must hold of every run.
#pragma once

#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "baselines/gcc.hpp"
#include "splat/reference_renderer.hpp"
#include "tests/modules/workload_fixture.hpp"

namespace degs::test {

/// A GCC for views of `view` px in double precision; everything else as by default.
inline GccConfig gcc_of(int view, int window = 8) {
    GccConfig c;
    c.pipeline.numbers = NumberFormat::Fp64;
    c.view_size = view;
    c.array.window = window;
    c.image_buffer.bytes = c.image_buffer.state_bytes * view * view;
    return c;
}

class GccRun {
public:
    GccRun(const std::string& name, const GccConfig& config,
           const std::vector<const FrameWorkload*>& frames, Fidelity fidelity = Fidelity::Exact,
           const BuildOptions& options = {})
        : time_{ClockDomain(config.clock_ghz), fidelity}, job_(make_render_job(frames, config)) {
        EXPECT_EQ(config.problem(), "");
        gcc_ = std::make_unique<Gcc>(name.c_str(), config, time_, job_, options);
    }
    const Gcc& gcc() const { return *gcc_; }
    const RenderJob& job() const { return job_; }
    const Image& image(std::size_t frame = 0) const { return job_.images[frame]; }
    AcceleratorResult result() const {
        AcceleratorResult r;
        r.clock_ghz = gcc_->config().clock_ghz;
        gcc_->collect(r);
        return r;
    }
    std::uint64_t stream_bytes(const std::string& name) const {
        for (const StreamUse& stream : result().streams) {
            if (stream.name == name) {
                return stream.bytes_read + stream.bytes_written;
            }
        }
        ADD_FAILURE() << name << " is no stream";
        return 0;
    }

    struct Words {
        std::string name;
        std::vector<std::uint64_t> values;
    };
    /// Every counter of every block.
    std::vector<Words> signature() const;

private:
    Timebase time_;
    RenderJob job_;
    std::unique_ptr<Gcc> gcc_;
};

inline std::vector<GccRun::Words> GccRun::signature() const {
    std::vector<Words> list;
    const auto add = [&list](const std::string& name, const auto& stats) {
        using Stats = std::decay_t<decltype(stats)>;
        static_assert(std::is_trivially_copyable_v<Stats> && sizeof(Stats) % 8 == 0);
        Words words{name, std::vector<std::uint64_t>(sizeof(Stats) / 8)};
        std::memcpy(words.values.data(), &stats, sizeof(Stats));
        list.push_back(words);
    };
    const auto add_unit = [&](const char* name, const auto* unit) {
        if (unit != nullptr) {
            add(name, unit->stats());
        }
    };
    add_unit("grouping", gcc_->grouping());
    add_unit("projection", gcc_->projection());
    add_unit("colour", gcc_->colour());
    add_unit("fetcher", gcc_->fetcher());
    add_unit("array", &gcc_->array());
    add_unit("image buffer", &gcc_->image_buffer());
    add_unit("monitor", &gcc_->monitor());
    for (std::size_t i = 0; i < gcc_->streams().names().size(); ++i) {
        add(gcc_->streams().names()[i], gcc_->streams().memory().stats(i));
    }
    for (const FrameDates& frame : result().frames) {
        add("frame", frame);
    }
    for (const BufferUse& buffer : result().buffers) {
        add(buffer.name + " full", buffer.full_cycles);
        add(buffer.name + " empty", buffer.empty_cycles);
        add(buffer.name + " fill", buffer.mean_fill);
    }
    return list;
}

inline void expect_same(const GccRun& a, const GccRun& b) {
    const auto left = a.signature();
    const auto right = b.signature();
    ASSERT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
        EXPECT_EQ(left[i].values, right[i].values) << left[i].name << ", entry " << i;
    }
    for (std::size_t f = 0; f < a.job().frames.size(); ++f) {
        EXPECT_EQ(a.image(f).rgb, b.image(f).rgb);
        EXPECT_EQ(a.image(f).transmittance, b.image(f).transmittance);
        EXPECT_EQ(a.image(f).fragments, b.image(f).fragments);
    }
}

/// Every view is done once, every law holds, the slots fill PEs x window.
inline void expect_sound(const GccRun& run) {
    const AcceleratorResult result = run.result();
    EXPECT_EQ(result.tiles, run.job().tiles.size());
    for (const Conservation& c : result.conservation) {
        EXPECT_EQ(c.left, c.right) << c.law;
    }
    EXPECT_EQ(result.slots.total(),
              result.window.cycles() * static_cast<std::uint64_t>(run.gcc().config().pes()));
}

/// In double precision with the reference's stop rule: the reference's pixels (single precision
/// stores them: one rounding either way), and as many updates.
inline void expect_reference(const GccRun& run) {
    std::uint64_t fragments = 0;
    for (std::size_t f = 0; f < run.job().frames.size(); ++f) {
        ReferenceCounts counts;
        const Image reference = render_reference(*run.job().frames[f], counts);
        EXPECT_EQ(run.image(f).fragments, reference.fragments) << "frame " << f;
        for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
            ASSERT_NEAR(run.image(f).rgb[i], reference.rgb[i],
                        1e-12 + 1.2e-7 * std::abs(reference.rgb[i]));
        }
        fragments += counts.fragments;
    }
    EXPECT_EQ(run.result().slots.useful, fragments);
}

} // namespace degs::test
