// SPDX-License-Identifier: Apache-2.0
// The renderer without time shows what an accelerator with the same numbers shows, bit by bit.
#include "accuracy/data_path_renderer.hpp"
#include "tests/modules/degs/run_fixture.hpp"

namespace degs {
namespace {

using test::DegsRun;
using test::random_frame;
using test::same_bytes;
using test::Shape;

struct Numbers {
    Arithmetic format;
    SpanEnds ends;
    int delta;
    StopRule stop;
    SlicedRows rows;
    int segment_length;
    bool parsing = true;
};
std::ostream& operator<<(std::ostream& out, const Numbers& n) {
    return out << arithmetic_names()[static_cast<std::size_t>(n.format)] << "_ends"
               << static_cast<int>(n.ends) << "_" << n.delta
               << (n.stop == StopRule::Refuse ? "_refuse" : "_after")
               << (n.rows == SlicedRows::Tile ? "_tile_" : "_splat_") << n.segment_length
               << (n.parsing ? "" : "_tested");
}

class SmallRunAgainstRenderer : public ::testing::TestWithParam<std::tuple<Numbers, Shape>> {};

TEST_P(SmallRunAgainstRenderer, SameImageAndTasks) {
    const auto& [numbers, shape] = GetParam();
    DegsConfig config = test::shaped({}, shape);
    config.pipeline.numbers = numbers.format;
    config.pipeline.span_ends = numbers.ends;
    config.pipeline.span_delta = numbers.delta;
    config.pipeline.stop_rule = numbers.stop;
    config.slicing.rows = numbers.rows;
    config.scheduler.segment_length = numbers.segment_length;
    config.span.parsing = numbers.parsing;
    const FrameWorkload frame = random_frame(7, 75, 53, shape.tile, 160);
    DegsRun run("degs", config, {&frame});
    sc_core::sc_start();

    DataPathRender options;
    options.numbers = config.data_path();
    options.rows_in_columns = numbers.rows == SlicedRows::Tile;
    options.parsing = numbers.parsing;
    DataPathRenderer renderer(frame, options);
    const Image image = renderer.render(all_tiles(frame));
    EXPECT_TRUE(same_bytes(image, run.image()));
    EXPECT_EQ(renderer.counts().useful, run.slots()[Slot::Useful]);
    EXPECT_GT(renderer.counts().terminated, 0U); // some pixels do end
}

constexpr Numbers kNumbers[] = {
    {Arithmetic::Fp64, SpanEnds::Exact, 0, StopRule::Refuse, SlicedRows::Splat, 16},
    {Arithmetic::Fp32, SpanEnds::Exact, 0, StopRule::Refuse, SlicedRows::Tile, 7},
    {Arithmetic::Fp32, SpanEnds::Outward, 0, StopRule::Refuse, SlicedRows::Splat, 16},
    {Arithmetic::Fp32, SpanEnds::Outward, 2, StopRule::After, SlicedRows::Tile, 1},
    {Arithmetic::Fp32, SpanEnds::Outward, 1, StopRule::After, SlicedRows::Splat, 32},
    {Arithmetic::Fp16, SpanEnds::Outward, 0, StopRule::Refuse, SlicedRows::Splat, 16},
    {Arithmetic::Paper, SpanEnds::Slope, 0, StopRule::Refuse, SlicedRows::Tile, 16},
    {Arithmetic::Paper, SpanEnds::Exact, 0, StopRule::After, SlicedRows::Splat, 5},
    {Arithmetic::Tuned, SpanEnds::Exact, 0, StopRule::Refuse, SlicedRows::Splat, 16},
    {Arithmetic::Tuned, SpanEnds::Outward, 1, StopRule::Refuse, SlicedRows::Tile, 9},
    {Arithmetic::Fp64, SpanEnds::Exact, 0, StopRule::Refuse, SlicedRows::Tile, 16, false},
    {Arithmetic::Fp32, SpanEnds::Outward, 0, StopRule::After, SlicedRows::Splat, 7, false},
    {Arithmetic::Paper, SpanEnds::Slope, 0, StopRule::Refuse, SlicedRows::Splat, 16, false},
    {Arithmetic::Tuned, SpanEnds::Exact, 0, StopRule::After, SlicedRows::Tile, 9, false},
};
INSTANTIATE_TEST_SUITE_P(Numbers, SmallRunAgainstRenderer,
                         ::testing::Combine(::testing::ValuesIn(kNumbers),
                                            ::testing::Values(Shape{16, 2, 8, 8, 8},
                                                              Shape{32, 2, 8, 8, 8})));

} // namespace
} // namespace degs
