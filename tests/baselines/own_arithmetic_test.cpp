// SPDX-License-Identifier: Apache-2.0
// What a baseline leaves out before its pixels check must not pass their check: the image is, bit
// by bit, that of pixels that check every splat of their tile's list, in every number format.
#include <cmath>

#include "baselines/gscore/engine.hpp"
#include "tests/baselines/engine_run.hpp"
#include "tests/baselines/gbu/gbu_fixture.hpp"
#include "tests/baselines/gcc/gcc_run.hpp"
#include "tests/modules/degs/soft_frame.hpp"
#include "tests/splat/pixels/checked_image.hpp"

namespace degs {
namespace {

using test::EngineRun;

/// Faint splats, so that lists are blended to their ends. Every fourth is wide and hardly visible:
/// where q is small, a rounding of it moves the rim by pixels.
FrameWorkload faint_frame(const AcceleratorConfig& config) {
    FrameWorkload frame = test::soft_frame(5, 1200, 120, 90, config.tile_size_px());
    for (std::size_t i = 0; i < frame.splats.size(); ++i) {
        ProjectedSplat& splat = frame.splats[i];
        const bool wide = i % 4 == 0;
        const double growth = wide ? 100 : 1;
        splat.cov_a *= growth;
        splat.cov_b *= growth;
        splat.cov_c *= growth;
        splat.det *= growth * growth;
        splat.opacity = (wide ? 0.00393 : 0.01) + (wide ? 0.0001 : 0.1) * splat.opacity;
        splat.q_threshold = 2 * std::log(255 * splat.opacity);
    }
    return frame;
}

/// A run of its own splats and what is expected of it.
struct OwnRun {
    OwnRun(const char* name, const AcceleratorConfig& config)
        : frame(faint_frame(config)), expected(test::checked_image(frame, config.data_path())),
          run(name, config, {&frame}) {}
    void expect_own_image() const {
        run.expect_sound();
        EXPECT_EQ(run.result().slots[Slot::Useful], expected.useful);
        EXPECT_TRUE(test::same_bytes(run.image(), expected.image));
    }
    FrameWorkload frame;
    test::BlendedImage expected;
    EngineRun run;
};

class SmallRunOwnArithmetic : public ::testing::TestWithParam<Arithmetic> {};

TEST_P(SmallRunOwnArithmetic, OfGbuIsThatOfItsPixels) {
    gbu::Config config = test::gbu_of(16, 4, 8);
    config.pipeline.numbers = GetParam();
    const OwnRun gbu("gbu", config);
    sc_core::sc_start();
    gbu.expect_own_image();
}

TEST_P(SmallRunOwnArithmetic, OfGscoreIsThatOfItsPixels) {
    gscore::Config config;
    config.pipeline.numbers = GetParam();
    config.array.lanes = 16;
    const OwnRun boxes("obb", config);
    config.array.subtile_skip = SubtileTest::Exact;
    const OwnRun exact("exact", config);
    sc_core::sc_start();
    {
        SCOPED_TRACE("obb");
        boxes.expect_own_image();
    }
    SCOPED_TRACE("exact");
    exact.expect_own_image();
    EXPECT_LE(exact.run.result().slots.total(), boxes.run.result().slots.total());
}

TEST_P(SmallRunOwnArithmetic, OfGccIsThatOfItsPixels) {
    gcc::Config config = test::gcc_of(64);
    config.pipeline.numbers = GetParam();
    const OwnRun gcc("gcc", config);
    sc_core::sc_start();
    gcc.expect_own_image();
}

std::string own_name(const ::testing::TestParamInfo<Arithmetic>& row) {
    return arithmetic_names()[static_cast<std::size_t>(row.param)];
}

INSTANTIATE_TEST_SUITE_P(Numbers, SmallRunOwnArithmetic,
                         ::testing::Values(Arithmetic::Fp32, Arithmetic::Fp64, Arithmetic::Fp16,
                                           Arithmetic::Paper, Arithmetic::Tuned),
                         own_name);

} // namespace
} // namespace degs
