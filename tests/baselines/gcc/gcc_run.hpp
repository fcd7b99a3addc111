// SPDX-License-Identifier: Apache-2.0
// Whole GCCs on frames made by hand, and what must hold of every run.
#pragma once

#include "baselines/gcc/engine.hpp"
#include "tests/modules/degs/accelerator_fixture.hpp"

namespace degs::test {

/// A GCC for views of `view` px in double precision; everything else as by default.
inline gcc::Config gcc_of(int view, int window = 8) {
    gcc::Config c;
    c.pipeline.numbers = Arithmetic::Fp64;
    c.view_size = view;
    c.array.window = window;
    c.image_buffer.bytes = c.image_buffer.state_bytes * view * view;
    return c;
}

class GccRun : public AcceleratorRun<gcc::Engine, gcc::Config> {
public:
    using AcceleratorRun::AcceleratorRun;
    const gcc::Engine& gcc() const { return engine(); }
    std::uint64_t stream_bytes(const std::string& name) const {
        for (const StreamUse& stream : result().streams) {
            if (stream.name == name) {
                return stream.bytes_read + stream.bytes_written;
            }
        }
        ADD_FAILURE() << name << " is no stream";
        return 0;
    }
    /// Every counter of every block.
    Signature signature() const;
};

inline Signature GccRun::signature() const {
    Signature words;
    words.add_unit("grouping", gcc().grouping());
    words.add_units("projection", gcc().projection());
    words.add_units("colour", gcc().colour());
    words.add_units("fetcher", gcc().fetchers());
    words.add_units("array", gcc().arrays());
    words.add_units("image buffer", gcc().image_buffers());
    words.add_units("monitor", gcc().monitors());
    words.add_streams(gcc().streams());
    for (const FrameDates& frame : result().frames) {
        words.add("frame", frame);
    }
    for (const BufferUse& buffer : result().buffers) {
        words.add(buffer.name + " full", buffer.full_cycles);
        words.add(buffer.name + " empty", buffer.empty_cycles);
        words.add(buffer.name + " fill", buffer.mean_fill);
    }
    return words;
}

inline void expect_same(const GccRun& a, const GccRun& b) {
    a.signature().expect_same(b.signature());
    for (std::size_t f = 0; f < a.job().frames.size(); ++f) {
        EXPECT_TRUE(same_bytes(a.image(f), b.image(f))) << "frame " << f;
    }
}

/// Every view is done once, every invariant holds.
inline void expect_sound(const GccRun& run) {
    EXPECT_EQ(run.result().tiles, run.job().tiles.size());
    expect_laws(run.result(), run.gcc().config().pes());
}

inline void expect_reference(const GccRun& run) {
    expect_reference_pixels(run.job(), run.result().slots[Slot::Useful]);
}

} // namespace degs::test
