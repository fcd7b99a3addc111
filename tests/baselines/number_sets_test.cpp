// SPDX-License-Identifier: Apache-2.0
// Every baseline in every number set: sound, finite, near the reference.
#include <cmath>

#include "baselines/gscore/engine.hpp"
#include "splat/images/image_metrics.hpp"
#include "tests/baselines/engine_run.hpp"
#include "tests/baselines/gbu/gbu_fixture.hpp"
#include "tests/baselines/gcc/gcc_run.hpp"
#include "tests/modules/degs/soft_frame.hpp"

namespace degs {
namespace {

using test::EngineRun;

class SmallRunNumberSets : public ::testing::TestWithParam<Arithmetic> {
protected:
    void expect_image(const EngineRun& run, const FrameWorkload& frame) const {
        run.expect_sound();
        ReferenceCounts counts;
        const Image reference = render_reference(frame, counts);
        for (const float channel : run.image().rgb) {
            ASSERT_TRUE(std::isfinite(channel));
        }
        // In the order of Arithmetic. Pixels check for themselves: no floor/ceil ends.
        const double least[] = {100, 100, 100, 40, 40, 60};
        EXPECT_GE(compare_images(reference, run.image()).psnr_db,
                  least[static_cast<std::size_t>(GetParam())]);
    }
};

FrameWorkload frame_for(const AcceleratorConfig& config) {
    return test::soft_frame(19, 150, 90, 70, config.tile_size_px());
}

TEST_P(SmallRunNumberSets, RunEverywhere) {
    gbu::Config gbu = test::gbu_of(16, 4, 8);
    gbu.pipeline.numbers = GetParam();
    gscore::Config gscore;
    gscore.pipeline.numbers = GetParam();
    gcc::Config gcc = test::gcc_of(64);
    gcc.pipeline.numbers = GetParam();
    const FrameWorkload gbu_frame = frame_for(gbu);
    const FrameWorkload gscore_frame = frame_for(gscore);
    const FrameWorkload gcc_frame = frame_for(gcc);
    const EngineRun first("gbu", gbu, {&gbu_frame});
    const EngineRun second("gscore", gscore, {&gscore_frame});
    const EngineRun third("gcc", gcc, {&gcc_frame});
    sc_core::sc_start();
    expect_image(first, gbu_frame);
    expect_image(second, gscore_frame);
    expect_image(third, gcc_frame);
}

std::string set_name(const ::testing::TestParamInfo<Arithmetic>& row) {
    constexpr const char* kNames[] = {"Ideal", "Fp16", "Paper", "Tuned"};
    return kNames[row.index];
}

INSTANTIATE_TEST_SUITE_P(Sets, SmallRunNumberSets,
                         ::testing::Values(Arithmetic::Ideal, Arithmetic::Fp16, Arithmetic::Paper,
                                           Arithmetic::Tuned),
                         set_name);

} // namespace
} // namespace degs
