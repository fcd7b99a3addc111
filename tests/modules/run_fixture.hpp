// SPDX-License-Identifier: Apache-2.0
// Whole accelerators on frames made by hand, and what must hold of every run.
#pragma once

#include <cstring>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "modules/degs.hpp"
#include "splat/reference_renderer.hpp"
#include "tests/modules/workload_fixture.hpp"

namespace degs::test {

/// The default design in double precision with exact span ends: its image is the reference's.
inline DegsConfig exact_arithmetic(DegsConfig config = {}) {
    config.pipeline.numbers = NumberFormat::Fp64;
    config.pipeline.span_ends = SpanEnds::Exact;
    config.pipeline.stop_rule = StopRule::Refuse;
    return config;
}

/// One of the paper's scaling points (Table II).
struct Shape {
    int tile, slicers, spans, banks, pes_per_bank;
};
inline std::ostream& operator<<(std::ostream& out, const Shape& s) {
    return out << s.tile << "px_" << s.slicers << "_" << s.spans << "_" << s.banks << "_"
               << s.pes_per_bank;
}
inline DegsConfig shaped(DegsConfig config, const Shape& shape) {
    config.tile_size = shape.tile;
    config.slicing.count = shape.slicers;
    config.span.count = shape.spans;
    config.scheduler.banks = shape.banks;
    config.array.pes_per_bank = shape.pes_per_bank;
    // Buffers grow with the array, as between the paper's points.
    config.pixel_buffer.bytes = config.pixel_buffer.state_bytes * shape.tile * shape.tile;
    const int scale = std::max(1, shape.banks * shape.pes_per_bank / 64);
    config.span_buffer.bytes *= scale;
    config.packing.bytes *= scale;
    config.feature_buffer.bytes *= scale;
    return config;
}

/// One accelerator with its job. Several may live in one elaboration.
class DegsRun {
public:
    DegsRun(const std::string& name, const DegsConfig& config,
            const std::vector<const FrameWorkload*>& frames, Fidelity fidelity = Fidelity::Exact,
            const BuildOptions& options = {})
        : time_{ClockDomain(config.clock_ghz), fidelity}, job_(make_render_job(frames, config)) {
        EXPECT_EQ(config.problem(), "");
        degs_ = std::make_unique<Degs>(name.c_str(), config, time_, job_, options);
    }
    const Degs& degs() const { return *degs_; }
    const RenderJob& job() const { return job_; }
    const Image& image(std::size_t frame = 0) const { return job_.images[frame]; }

    /// Slots of the whole blending window, by class; see architecture, slot accounting.
    SlotAccount slots() const {
        const auto width = static_cast<std::uint64_t>(degs_->config().array.pes_per_bank);
        const ActiveWindow all = window();
        SlotAccount sum;
        for (std::size_t b = 0; b < degs_->slices().size(); ++b) {
            const ActiveWindow& own = degs_->slices()[b]->stats().window;
            sum += degs_->slices()[b]->stats().slots;
            sum += degs_->packing()[b]->idle();
            if (own.empty()) {
                sum.drain += all.cycles() * width;
            } else {
                sum.starved += (own.first - all.first) * width;
                sum.drain += (all.last - own.last) * width;
            }
        }
        return sum;
    }
    ActiveWindow window() const {
        ActiveWindow all;
        for (const auto& slice : degs_->slices()) {
            if (!slice->stats().window.empty()) {
                all.include(slice->stats().window);
            }
        }
        return all;
    }
    template <class Field>
    std::uint64_t slices(Field ArraySlice::Stats::*field) const {
        std::uint64_t sum = 0;
        for (const auto& slice : degs_->slices()) {
            sum += slice->stats().*field;
        }
        return sum;
    }
    template <class Field>
    std::uint64_t banks(Field IssueBank::Stats::*field) const {
        std::uint64_t sum = 0;
        for (const auto& bank : degs_->banks()) {
            sum += bank->stats().*field;
        }
        return sum;
    }
    std::uint64_t hazards() const { return slices(&ArraySlice::Stats::hazards); }
    std::uint64_t packets() const { return slices(&ArraySlice::Stats::packets); }
    std::uint64_t span_tasks() const {
        std::uint64_t sum = 0;
        for (const auto& unit : degs_->spans()) {
            sum += unit->stats().tasks;
        }
        return sum;
    }

    /// The statistics of one block: 64-bit counters, whatever their names are.
    struct Words {
        std::string name;
        std::vector<std::uint64_t> values;
    };
    std::vector<Words> signature() const;

private:
    Timebase time_;
    RenderJob job_;
    std::unique_ptr<Degs> degs_;
};

inline std::vector<DegsRun::Words> DegsRun::signature() const {
    std::vector<Words> list;
    const auto add = [&list](const std::string& name, const auto& stats) {
        using Stats = std::decay_t<decltype(stats)>;
        static_assert(std::is_trivially_copyable_v<Stats> && sizeof(Stats) % 8 == 0);
        Words words{name, std::vector<std::uint64_t>(sizeof(Stats) / 8)};
        std::memcpy(words.values.data(), &stats, sizeof(Stats));
        list.push_back(words);
    };
    const auto all = [&](const auto& units) {
        for (const auto& unit : units) {
            add(unit->name(), unit->stats());
        }
    };
    add("finished", degs_->finished());
    all(degs_->front_end().projection());
    if (degs_->front_end().binner() != nullptr) {
        add("binner", degs_->front_end().binner()->stats());
    }
    all(degs_->front_end().sorting());
    all(degs_->fetchers());
    all(degs_->slicing());
    all(degs_->spans());
    all(degs_->banks());
    all(degs_->packing());
    all(degs_->slices());
    all(degs_->pixel_buffers());
    add("monitor", degs_->monitor().stats());
    for (const auto& unit : degs_->packing()) {
        add("idle slots", unit->idle());
    }
    for (const auto& bank : degs_->banks()) {
        add("feature waits", bank->feature_waits());
    }
    const MemoryStreams& streams = degs_->streams();
    for (std::size_t i = 0; i < streams.names().size(); ++i) {
        add(streams.names()[i], streams.memory().stats(i));
    }
    add("gaussian buffer", degs_->gaussian_buffer());
    add("span buffer", degs_->span_buffer());
    add("crossbar", degs_->crossbar());
    add("packing buffer", degs_->packing_buffer());
    return list;
}

/// Every counter of every block.
inline void expect_same_statistics(const DegsRun& a, const DegsRun& b) {
    const auto left = a.signature();
    const auto right = b.signature();
    ASSERT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
        EXPECT_EQ(left[i].values, right[i].values) << left[i].name;
    }
}

inline bool same_bytes(const Image& a, const Image& b) {
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() &&
               (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
    };
    return same(a.rgb, b.rgb) && same(a.transmittance, b.transmittance) &&
           same(a.fragments, b.fragments);
}

/// Conservation laws of every finished run.
inline void expect_sound(const DegsRun& run) {
    const Degs& degs = run.degs();
    const SlotAccount slots = run.slots();
    EXPECT_EQ(slots.total(),
              run.window().cycles() * static_cast<std::uint64_t>(degs.config().pes()));
    const std::uint64_t issued = run.banks(&IssueBank::Stats::tasks_issued);
    EXPECT_EQ(run.span_tasks(), run.banks(&IssueBank::Stats::tasks_in));
    EXPECT_EQ(run.span_tasks(), issued + run.banks(&IssueBank::Stats::tasks_dropped));
    EXPECT_EQ(issued, slots.useful + slots.boundary + slots.terminated);
    if (degs.config().scheduler.scoreboard) {
        EXPECT_EQ(run.hazards(), 0U);
    }
    std::uint64_t tiles = 0;
    for (const auto& unit : degs.pixel_buffers()) {
        tiles += unit->stats().tiles;
    }
    EXPECT_EQ(tiles, run.job().tiles.size() * degs.pixel_buffers().size());
    EXPECT_EQ(degs.monitor().stats().tiles, run.job().tiles.size());
}

/// In double precision with exact ends and the reference's stop rule.
inline void expect_reference(const DegsRun& run) {
    std::uint64_t fragments = 0;
    for (std::size_t f = 0; f < run.job().frames.size(); ++f) {
        ReferenceCounts counts;
        const Image reference = render_reference(*run.job().frames[f], counts);
        EXPECT_TRUE(same_bytes(run.image(f), reference)) << "frame " << f;
        fragments += counts.fragments;
    }
    EXPECT_EQ(run.slots().useful, fragments);
}

} // namespace degs::test
