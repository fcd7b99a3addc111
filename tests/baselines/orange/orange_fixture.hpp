// SPDX-License-Identifier: Apache-2.0
// Whole ORANGEs on frames made by hand, and what must hold of every run.
#pragma once

#include "baselines/orange/engine.hpp"
#include "tests/modules/degs/accelerator_fixture.hpp"

namespace degs::test {

/// `cores` cores of `rows` x `columns` multipliers for tiles of `tile` px in double precision;
/// buffers as large as needed.
inline orange::Config orange_of(int tile, int cores, int rows = 32, int columns = 32) {
    orange::Config c;
    c.pipeline.numbers = Arithmetic::Fp64;
    c.tile_size = tile;
    c.cores.count = cores;
    c.cores.array.rows = rows;
    c.cores.array.columns = columns;
    c.pixel_buffer.bytes = 2 * cores * tile * tile * 32;
    c.scratchpad.bytes = 1 << 24;
    return c;
}

class OrangeRun : public AcceleratorRun<orange::Engine, orange::Config> {
public:
    using AcceleratorRun::AcceleratorRun;
    const orange::Engine& orange() const { return engine(); }
    /// Every counter of every block.
    Signature signature() const {
        Signature words;
        words.add_units("projection", orange().front_end().projection());
        words.add_units("sorting", orange().front_end().hierarchical());
        words.add("dispatcher", orange().dispatcher().stats());
        words.add_units("fetchers", orange().fetchers());
        words.add_units("vector units", orange().vector_units());
        words.add_units("arrays", orange().arrays());
        words.add_units("pixel buffers", orange().pixel_buffers());
        words.add_units("monitors", orange().monitors());
        words.add_streams(orange().streams());
        words.add("slots", result().slots);
        words.add("window", result().window);
        for (const FrameDates& frame : result().frames) {
            words.add("frame", frame);
        }
        return words;
    }
};

/// Every tile is done once, every invariant holds.
inline void expect_sound(const OrangeRun& run) {
    const AcceleratorResult result = run.result();
    EXPECT_EQ(result.tiles, run.job().tiles.size());
    expect_laws(result, run.orange().config().pes());
    EXPECT_EQ(result.slots[Slot::Conflict] + result.slots[Slot::Ports], 0U);
    EXPECT_EQ(result.slots[Slot::Useful] % kGemmDepth, 0U);
}

inline void expect_reference(const OrangeRun& run) {
    expect_reference_pixels(run.job(), run.result().fragments());
}

} // namespace degs::test
