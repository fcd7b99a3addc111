// SPDX-License-Identifier: Apache-2.0
// Whole runs in number sets: finite, sound, and as near to the reference as their formats are.
#include <cmath>
#include <limits>

#include "splat/images/image_metrics.hpp"
#include "tests/modules/degs/run_fixture.hpp"
#include "tests/modules/degs/soft_frame.hpp"

namespace degs {
namespace {

using test::DegsRun;

struct Quality {
    Arithmetic numbers;
    double psnr_db; ///< at least, with exact span ends
};

std::ostream& operator<<(std::ostream& out, const Quality& q) {
    return out << arithmetic_names()[static_cast<std::size_t>(q.numbers)];
}

DegsConfig config_of(Arithmetic numbers, SpanEnds ends) {
    DegsConfig config = test::shaped({}, {32, 2, 8, 8, 8});
    config.pipeline.numbers = numbers;
    config.pipeline.span_ends = ends;
    return config;
}

class SmallRunNumbers : public ::testing::TestWithParam<Quality> {};

TEST_P(SmallRunNumbers, AreAsNearAsTheirFormats) {
    const FrameWorkload frame = test::soft_frame(11, 400, 200, 140, 32);
    const DegsRun exact("exact", config_of(GetParam().numbers, SpanEnds::Exact), {&frame});
    const DegsRun slope("slope", config_of(GetParam().numbers, SpanEnds::Slope), {&frame});
    sc_core::sc_start();
    for (const DegsRun* run : {&exact, &slope}) {
        test::expect_sound(*run);
        for (const float channel : run->image().rgb) {
            ASSERT_TRUE(std::isfinite(channel));
        }
    }
    EXPECT_GT(slope.span_tasks(), exact.span_tasks());
    ReferenceCounts counts;
    const Image reference = render_reference(frame, counts);
    const ImageError error = compare_images(reference, exact.image());
    EXPECT_GE(error.psnr_db, GetParam().psnr_db);
    if (std::isinf(GetParam().psnr_db)) {
        EXPECT_TRUE(test::same_bytes(exact.image(), reference));
    } else { // neither is it something else under the set's name
        EXPECT_LT(error.psnr_db, GetParam().psnr_db + 45);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Sets, SmallRunNumbers,
    ::testing::Values(Quality{Arithmetic::Ideal, std::numeric_limits<double>::infinity()},
                      Quality{Arithmetic::Fp32, 100}, Quality{Arithmetic::Fp16, 30},
                      Quality{Arithmetic::Paper, 40}, Quality{Arithmetic::Tuned, 60}));

// A delta of its own, beside what the ends have.
TEST(SmallRunSpanEnds, DeltaWidensThem) {
    const FrameWorkload frame =
        test::make_frame({test::make_splat(64, 16, 10, 3, 0, 0.9)}, 128, 32, 32);
    DegsConfig config = config_of(Arithmetic::Paper, SpanEnds::Outward);
    const DegsRun outward("outward", config, {&frame});
    config.pipeline.span_delta = 1;
    const DegsRun wider("wider", config, {&frame});
    sc_core::sc_start();
    std::uint64_t spans = 0;
    for (const auto& unit : outward.degs().spans()) {
        spans += unit->stats().spans;
    }
    // The splat ends inside the image, and the tiles' borders cut none of its ends off by a pixel.
    EXPECT_GE(wider.span_tasks(), outward.span_tasks() + spans / 2);
    EXPECT_LE(wider.span_tasks(), outward.span_tasks() + 2 * spans);
}

} // namespace
} // namespace degs
