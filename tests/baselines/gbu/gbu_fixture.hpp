// SPDX-License-Identifier: Apache-2.0
// Whole GBUs on frames made by hand, and what must hold of every run.
#pragma once

#include "baselines/gbu/engine.hpp"
#include "tests/modules/degs/accelerator_fixture.hpp"

namespace degs::test {

/// A GBU of `engines` engines for tiles of `tile` px in double precision; buffers as large as
/// needed.
inline gbu::Config gbu_of(int tile, int engines, int row_pes) {
    gbu::Config c;
    c.pipeline.numbers = Arithmetic::Fp64;
    c.tile_size = tile;
    c.engines.count = engines;
    c.engines.row_pes = row_pes;
    c.pixel_buffer.bytes = 2 * engines * tile * tile * c.pixel_buffer.state_bytes;
    return c;
}

class GbuRun : public AcceleratorRun<gbu::Engine, gbu::Config> {
public:
    using AcceleratorRun::AcceleratorRun;
    const gbu::Engine& gbu() const { return engine(); }
    /// Every counter of every block.
    Signature signature() const;
};

inline Signature GbuRun::signature() const {
    Signature words;
    words.add_units("projection", gbu().front_end().projection());
    words.add_units("sorting", gbu().front_end().hierarchical());
    words.add("dispatcher", gbu().dispatcher().stats());
    words.add_units("fetchers", gbu().fetchers());
    words.add_units("caches", gbu().caches());
    words.add_units("engines", gbu().engines());
    words.add_units("pixel buffers", gbu().pixel_buffers());
    words.add_units("monitors", gbu().monitors());
    words.add_streams(gbu().streams());
    words.add("splat buffer", gbu().splat_buffer());
    for (const FrameDates& frame : result().frames) {
        words.add("frame", frame);
    }
    return words;
}

inline void expect_same_statistics(const GbuRun& a, const GbuRun& b) {
    a.signature().expect_same(b.signature());
}

/// Every tile is done once, every invariant holds; rows are bound to PEs, so nothing conflicts.
inline void expect_sound(const GbuRun& run) {
    const AcceleratorResult result = run.result();
    EXPECT_EQ(result.tiles, run.job().tiles.size());
    expect_laws(result, run.gbu().config().pes());
    EXPECT_EQ(result.slots[Slot::Conflict], 0U);
}

inline void expect_reference(const GbuRun& run) {
    expect_reference_pixels(run.job(), run.result().slots[Slot::Useful]);
}

} // namespace degs::test
