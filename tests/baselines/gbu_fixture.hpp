// SPDX-License-Identifier: Apache-2.0
// Whole GBUs on frames made by hand, and what must hold of every run.
#pragma once

#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "baselines/gbu.hpp"
#include "splat/reference_renderer.hpp"
#include "tests/modules/workload_fixture.hpp"

namespace degs::test {

/// A GBU of `engines` engines for tiles of `tile` px in double precision; buffers as large as
/// needed.
inline GbuConfig gbu_of(int tile, int engines, int row_pes) {
    GbuConfig c;
    c.pipeline.numbers = NumberFormat::Fp64;
    c.tile_size = tile;
    c.engines.count = engines;
    c.engines.row_pes = row_pes;
    c.pixel_buffer.bytes = 2 * engines * tile * tile * c.pixel_buffer.state_bytes;
    return c;
}

class GbuRun {
public:
    GbuRun(const std::string& name, const GbuConfig& config,
           const std::vector<const FrameWorkload*>& frames, Fidelity fidelity = Fidelity::Exact,
           const BuildOptions& options = {})
        : time_{ClockDomain(config.clock_ghz), fidelity}, job_(make_render_job(frames, config)) {
        EXPECT_EQ(config.problem(), "");
        gbu_ = std::make_unique<Gbu>(name.c_str(), config, time_, job_, options);
    }
    const Gbu& gbu() const { return *gbu_; }
    const RenderJob& job() const { return job_; }
    AcceleratorResult result() const {
        AcceleratorResult r;
        r.clock_ghz = gbu_->config().clock_ghz;
        gbu_->collect(r);
        return r;
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
    std::unique_ptr<Gbu> gbu_;
};

inline std::vector<GbuRun::Words> GbuRun::signature() const {
    std::vector<Words> list;
    const auto add = [&list](const std::string& name, const auto& stats) {
        using Stats = std::decay_t<decltype(stats)>;
        static_assert(std::is_trivially_copyable_v<Stats> && sizeof(Stats) % 8 == 0);
        Words words{name, std::vector<std::uint64_t>(sizeof(Stats) / 8)};
        std::memcpy(words.values.data(), &stats, sizeof(Stats));
        list.push_back(words);
    };
    const auto all = [&](const char* name, const auto& units) {
        for (const auto& unit : units) {
            add(name, unit->stats());
        }
    };
    all("projection", gbu_->front_end().projection());
    all("sorting", gbu_->front_end().hierarchical());
    add("dispatcher", gbu_->dispatcher().stats());
    all("fetchers", gbu_->fetchers());
    all("caches", gbu_->caches());
    all("engines", gbu_->engines());
    all("pixel buffers", gbu_->pixel_buffers());
    all("monitors", gbu_->monitors());
    for (std::size_t i = 0; i < gbu_->streams().names().size(); ++i) {
        add(gbu_->streams().names()[i], gbu_->streams().memory().stats(i));
    }
    add("splat buffer", gbu_->splat_buffer());
    for (const FrameDates& frame : result().frames) {
        add("frame", frame);
    }
    return list;
}

inline void expect_same_statistics(const GbuRun& a, const GbuRun& b) {
    const auto left = a.signature();
    const auto right = b.signature();
    ASSERT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
        EXPECT_EQ(left[i].values, right[i].values) << left[i].name << ", entry " << i;
    }
}

/// Every tile is done once, every law holds, the slots fill PEs x window.
inline void expect_sound(const GbuRun& run) {
    const AcceleratorResult result = run.result();
    EXPECT_EQ(result.tiles, run.job().tiles.size());
    for (const Conservation& c : result.conservation) {
        EXPECT_EQ(c.left, c.right) << c.law;
    }
    EXPECT_EQ(result.slots.total(),
              result.window.cycles() * static_cast<std::uint64_t>(run.gbu().config().pes()));
    EXPECT_EQ(result.slots.conflict, 0U);
}

/// In double precision: the reference's pixels, and as many updates.
inline void expect_reference(const GbuRun& run) {
    std::uint64_t fragments = 0;
    for (std::size_t f = 0; f < run.job().frames.size(); ++f) {
        ReferenceCounts counts;
        const Image reference = render_reference(*run.job().frames[f], counts);
        const Image& image = run.job().images[f];
        EXPECT_EQ(image.fragments, reference.fragments) << "frame " << f;
        for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
            // Both are doubles rounded to float: a last-place difference of the doubles may show.
            ASSERT_NEAR(image.rgb[i], reference.rgb[i], 1e-12 + 6e-8 * reference.rgb[i]);
        }
        fragments += counts.fragments;
    }
    EXPECT_EQ(run.result().slots.useful, fragments);
}

} // namespace degs::test
