// SPDX-License-Identifier: Apache-2.0
// Whole accelerators of any kind on frames made by hand, and what must hold of every run.
#pragma once

#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "modules/kit/accelerator/accelerator_result.hpp"
#include "modules/kit/accelerator/render_engine.hpp"
#include "modules/kit/memory/memory_streams.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/modules/degs/workload_fixture.hpp"

namespace degs::test {

/// Counters of blocks as plain words, whatever their names are, to compare runs by.
class Signature {
public:
    template <class Stats>
    void add(const std::string& name, const Stats& stats) {
        static_assert(std::is_trivially_copyable_v<Stats> && sizeof(Stats) % 8 == 0);
        Words words{name, std::vector<std::uint64_t>(sizeof(Stats) / 8)};
        std::memcpy(words.values.data(), &stats, sizeof(Stats));
        list_.push_back(words);
    }
    /// A block that is not always there.
    template <class Unit>
    void add_unit(const char* name, const Unit* unit) {
        if (unit != nullptr) {
            add(name, unit->stats());
        }
    }
    template <class Units>
    void add_units(const char* name, const Units& units) {
        for (const auto& unit : units) {
            add(name, unit->stats());
        }
    }
    void add_streams(const MemoryStreams& streams) {
        for (std::size_t i = 0; i < streams.size(); ++i) {
            add(streams.name(i), streams.traffic(i));
        }
    }
    void expect_same(const Signature& other) const {
        ASSERT_EQ(list_.size(), other.list_.size());
        for (std::size_t i = 0; i < list_.size(); ++i) {
            EXPECT_EQ(list_[i].values, other.list_[i].values) << list_[i].name << ", entry " << i;
        }
    }

private:
    struct Words {
        std::string name;
        std::vector<std::uint64_t> values;
    };
    std::vector<Words> list_;
};

/// What a run records: nothing, its tiles, or those and a timeline.
enum class Watch { Nothing, Tiles, Timeline };

/// One accelerator with its job. Several may live in one elaboration.
template <class Engine, class Config>
class AcceleratorRun {
public:
    AcceleratorRun(const std::string& name, const Config& config,
                   const std::vector<const FrameWorkload*>& frames,
                   Fidelity fidelity = Fidelity::Exact, const BuildOptions& options = {},
                   Watch watch = Watch::Nothing)
        : timeline_(Timeline::Config{}), time_{ClockDomain(config.clock_ghz), fidelity,
                                               watch == Watch::Timeline ? &timeline_ : nullptr,
                                               &activations_},
          job_(make_render_job(frames, config)) {
        EXPECT_EQ(config.problem(), "");
        if (watch != Watch::Nothing) {
            job_.recorder = std::make_unique<SlotRecorder>(time_.timeline);
        }
        engine_ = std::make_unique<Engine>(name.c_str(), config, time_, job_, options);
    }
    const Engine& engine() const { return *engine_; }
    const RenderJob& job() const { return job_; }
    const Image& image(std::size_t frame = 0) const { return job_.images[frame]; }
    AcceleratorResult result() const {
        AcceleratorResult r;
        r.clock_ghz = engine_->config().clock_ghz;
        engine_->collect(r);
        return r;
    }
    /// The timeline of a run with Watch::Timeline that has ended at `end`.
    TimelineRecord timeline(Cycle end) { return timeline_.record(end); }

private:
    Timeline timeline_;
    std::uint64_t activations_ = 0;
    Timebase time_;
    RenderJob job_;
    std::unique_ptr<Engine> engine_;
};

inline bool same_bytes(const Image& a, const Image& b) {
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() &&
               (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
    };
    return same(a.rgb, b.rgb) && same(a.transmittance, b.transmittance) &&
           same(a.fragments, b.fragments);
}

/// Every invariant that the engine states itself; the slots fill PEs x window.
inline void expect_laws(const AcceleratorResult& result, int pes) {
    EXPECT_EQ(result.slots.total(), result.window.cycles() * static_cast<std::uint64_t>(pes));
    EXPECT_EQ(result.hazards, 0U);
    for (const Conservation& c : result.conservation) {
        EXPECT_EQ(c.left, c.right) << c.law;
    }
}

/// In double precision with the reference's stop rule: the reference's pixels, but for the rounding
/// to float, which may take the last bit either way, and as many updates.
inline void expect_reference_pixels(const RenderJob& job, std::uint64_t useful) {
    std::uint64_t fragments = 0;
    for (std::size_t f = 0; f < job.frames.size(); ++f) {
        ReferenceCounts counts;
        const Image reference = render_reference(*job.frames[f], counts);
        fragments += counts.fragments;
        ASSERT_EQ(job.images[f].fragments, reference.fragments) << "frame " << f;
        for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
            const double value = reference.rgb[i];
            ASSERT_NEAR(job.images[f].rgb[i], value, 1e-12 + 0x1p-23 * std::abs(value));
        }
    }
    EXPECT_EQ(useful, fragments);
}

} // namespace degs::test
