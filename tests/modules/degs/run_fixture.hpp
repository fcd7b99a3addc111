// SPDX-License-Identifier: Apache-2.0
// Whole accelerators on frames made by hand, and what must hold of every run.
#pragma once

#include "modules/degs/engine.hpp"
#include "tests/modules/degs/accelerator_fixture.hpp"

namespace degs::test {

/// The default design in double precision with exact span ends: its image is the reference's.
inline DegsConfig exact_arithmetic(DegsConfig config = {}) {
    config.pipeline.numbers = Arithmetic::Fp64;
    config.pipeline.span_ends = SpanEnds::Exact;
    config.pipeline.stop_rule = StopRule::Refuse;
    return config;
}

/// One of the paper's scaling points (Table III).
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

class DegsRun : public AcceleratorRun<Degs, DegsConfig> {
public:
    using AcceleratorRun::AcceleratorRun;
    const Degs& degs() const { return engine(); }

    /// Slots of the whole blending window, by class; see architecture, slot accounting.
    SlotAccount slots() const {
        const auto width = static_cast<std::uint64_t>(degs().config().array.pes_per_bank);
        const ActiveWindow all = window();
        SlotAccount sum;
        for (std::size_t b = 0; b < degs().slices().size(); ++b) {
            const ActiveWindow& own = degs().slices()[b]->stats().window;
            sum += degs().slices()[b]->stats().slots;
            sum += degs().packing()[b]->idle();
            if (own.empty()) {
                sum[Slot::Drain] += all.cycles() * width;
            } else {
                sum[Slot::Starved] += (own.first - all.first) * width;
                sum[Slot::Drain] += (all.last - own.last) * width;
            }
        }
        return sum;
    }
    ActiveWindow window() const {
        ActiveWindow all;
        for (const auto& slice : degs().slices()) {
            if (!slice->stats().window.empty()) {
                all.include(slice->stats().window);
            }
        }
        return all;
    }
    template <class Field>
    std::uint64_t slices(Field ArraySlice::Stats::*field) const {
        std::uint64_t sum = 0;
        for (const auto& slice : degs().slices()) {
            sum += slice->stats().*field;
        }
        return sum;
    }
    template <class Field>
    std::uint64_t banks(Field IssueBank::Stats::*field) const {
        std::uint64_t sum = 0;
        for (const auto& bank : degs().banks()) {
            sum += bank->stats().*field;
        }
        return sum;
    }
    std::uint64_t hazards() const { return slices(&ArraySlice::Stats::hazards); }
    std::uint64_t packets() const { return slices(&ArraySlice::Stats::packets); }
    std::uint64_t span_tasks() const {
        std::uint64_t sum = 0;
        for (const auto& unit : degs().spans()) {
            sum += unit->stats().tasks;
        }
        return sum;
    }

    /// Every counter of every block.
    Signature signature() const;
};

inline Signature DegsRun::signature() const {
    Signature words;
    words.add("finished", degs().finished());
    words.add_units("projection", degs().front_end().projection());
    words.add_unit("binner", degs().front_end().binner());
    words.add_units("sorting", degs().front_end().sorting());
    words.add_units("fetchers", degs().fetchers());
    words.add_unit("supply", degs().supply());
    words.add_units("slicing", degs().slicing());
    words.add_units("spans", degs().spans());
    words.add_units("banks", degs().banks());
    words.add_units("packing", degs().packing());
    words.add_units("slices", degs().slices());
    words.add_units("pixel buffers", degs().pixel_buffers());
    words.add_units("monitors", degs().monitors());
    for (const auto& unit : degs().packing()) {
        words.add("idle slots", unit->idle());
    }
    for (const auto& bank : degs().banks()) {
        words.add("feature waits", bank->features().stats().waits);
    }
    words.add_streams(degs().streams());
    words.add("gaussian buffer", degs().gaussian_buffer());
    words.add("span buffer", degs().span_buffer());
    words.add("crossbar", degs().crossbar());
    words.add("packing buffer", degs().packing_buffer());
    return words;
}

inline void expect_same_statistics(const DegsRun& a, const DegsRun& b) {
    a.signature().expect_same(b.signature());
}

/// Invariants of every finished run.
inline void expect_sound(const DegsRun& run) {
    const Degs& degs = run.degs();
    const SlotAccount slots = run.slots();
    EXPECT_EQ(slots.total(),
              run.window().cycles() * static_cast<std::uint64_t>(degs.config().pes()));
    const std::uint64_t issued = run.banks(&IssueBank::Stats::tasks_issued);
    EXPECT_EQ(run.span_tasks(), run.banks(&IssueBank::Stats::tasks_in));
    EXPECT_EQ(run.span_tasks(), issued + run.banks(&IssueBank::Stats::tasks_dropped));
    EXPECT_EQ(issued, slots[Slot::Useful] + slots[Slot::Boundary] + slots[Slot::Terminated]);
    if (degs.config().scheduler.scoreboard) {
        EXPECT_EQ(run.hazards(), 0U);
    }
    if (degs.supply() != nullptr) {
        const SplatSupply::Stats& supply = degs.supply()->stats();
        EXPECT_EQ(sum_of(degs.fetchers(), &SplatFetcher::Stats::records), supply.records.requested);
        EXPECT_EQ(supply.records.requested,
                  supply.records.read + supply.records.captured + supply.records.hits);
        EXPECT_EQ(supply.records.requested, supply.delivered);
    }
    const std::size_t streams = degs.monitors().size();
    EXPECT_EQ(sum_of(degs.pixel_buffers(), &PixelBuffer::Stats::tiles),
              run.job().tiles.size() * degs.pixel_buffers().size() / streams);
    EXPECT_EQ(sum_of(degs.monitors(), &TileMonitor::Stats::tiles), run.job().tiles.size());
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
    EXPECT_EQ(run.slots()[Slot::Useful], fragments);
}

} // namespace degs::test
