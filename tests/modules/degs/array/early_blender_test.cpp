// SPDX-License-Identifier: Apache-2.0
// An array without a scoreboard: tasks read what is written back at their date and nothing newer.
#include "modules/degs/array/early_blender.hpp"

#include <cmath>

#include "tests/modules/degs/run_fixture.hpp"

namespace degs {
namespace {

using test::DegsRun;
using test::exact_arithmetic;
using test::make_frame;
using test::one_pixel;

constexpr double kNear = 1e-12;

/// Splats on the pixel (3, 2): red, green and blue.
std::vector<ProjectedSplat> three_splats(double red, double green, double blue) {
    std::vector<ProjectedSplat> splats{one_pixel(3, 2, red), one_pixel(3, 2, green),
                                       one_pixel(3, 2, blue)};
    for (std::size_t i = 0; i < splats.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            splats[i].colour[c] = c == i ? 1.0F : 0.0F;
        }
    }
    return splats;
}

/// One tile of 16 x 16 px in double precision, and the tasks of its splats on row 2.
struct Bench {
    FrameWorkload frame;
    RenderJob job;

    explicit Bench(const std::vector<ProjectedSplat>& splats, Arithmetic numbers = Arithmetic::Fp64)
        : frame(make_frame(splats, 16, 16, 16)),
          job(make_render_job({&frame}, numbers_of(numbers), 1)) {}

    static DataPathOptions numbers_of(Arithmetic numbers) {
        DataPathOptions options;
        options.numbers = numbers;
        return options;
    }
    TaskRun run_of(std::uint32_t splat) const {
        const std::optional<RowSpan> span = job.path->solve_row(splat, 2, 0, 16, 0);
        TaskRun run;
        run.task.g0 = span->g0;
        run.task.d0 = span->d0;
        run.task.splat = splat;
        run.task.mask = ((1U << span->length) - 1) << span->x0;
        run.task.row = 2;
        run.task.offset = inside_tile(-span->base);
        run.part = run.task.mask;
        return run;
    }
    PixelValue pixel(int column = 3) const { return job.path->read_pixel(0, 2, column); }
};

void expect_pixel(const PixelValue& pixel, double transmittance, double red, double green,
                  double blue, std::uint32_t updates) {
    EXPECT_NEAR(pixel.transmittance, transmittance, kNear);
    EXPECT_NEAR(pixel.rgb[0], red, kNear);
    EXPECT_NEAR(pixel.rgb[1], green, kNear);
    EXPECT_NEAR(pixel.rgb[2], blue, kNear);
    EXPECT_EQ(pixel.updates, updates);
}

// Write-back after 4 cycles. Green comes 2 cycles after red and does not see it; blue comes 4 after
// red, sees red and not green, and its write-back replaces green's.
TEST(EarlyBlender, ReadsTheStateThatIsWrittenBackAtItsDate) {
    Bench bench(three_splats(0.5, 0.25, 0.2));
    EarlyBlender pes(bench.job, 4);
    EXPECT_EQ(pes.blend(bench.run_of(0), 10).useful, 1U << 3);
    expect_pixel(bench.pixel(), 1, 0, 0, 0, 1);
    EXPECT_EQ(pes.blend(bench.run_of(1), 12).useful, 1U << 3);
    expect_pixel(bench.pixel(), 1, 0, 0, 0, 2);
    EXPECT_EQ(pes.blend(bench.run_of(2), 14).useful, 1U << 3);
    expect_pixel(bench.pixel(), 0.5, 0.5, 0, 0, 3); // red is written back, green is not
    pes.finish(0);
    expect_pixel(bench.pixel(), 0.5 * 0.8, 0.5, 0, 0.5 * 0.2, 3);
}

// The reuse distance apart, nothing is lost; the pixels of other rows and tasks stay as they are.
TEST(EarlyBlender, TasksFarApartAreBlendedAsInOrder) {
    for (std::size_t n = 0; n < arithmetic_names().size(); ++n) {
        const auto numbers = static_cast<Arithmetic>(n);
        SCOPED_TRACE(name_of(numbers));
        std::vector<ProjectedSplat> splats = three_splats(0.5, 0.25, 0.2);
        splats.push_back(test::one_row(2, 9, 2, 0.7));
        splats.push_back(test::one_row(0, 12, 2, 0.995)); // ends pixels
        splats.push_back(splats[4]);
        splats.push_back(splats[4]);
        Bench early(splats, numbers);
        Bench plain(splats, numbers);
        EarlyBlender pes(early.job, 4);
        std::uint32_t ended = 0;
        for (std::uint32_t i = 0; i < splats.size(); ++i) {
            const BlendOutcome a = pes.blend(early.run_of(i), 10 + 4 * i);
            const BlendOutcome b = plain.job.path->blend(plain.run_of(i).task);
            EXPECT_EQ(a.useful, b.useful);
            EXPECT_EQ(a.boundary, b.boundary);
            EXPECT_EQ(a.terminated, b.terminated);
            EXPECT_EQ(a.ended, b.ended);
            ended |= a.ended;
        }
        EXPECT_NE(ended, 0U);
        pes.finish(0);
        for (int x = 0; x < 16; ++x) {
            const PixelValue a = early.pixel(x);
            const PixelValue b = plain.pixel(x);
            EXPECT_EQ(a.transmittance, b.transmittance) << x;
            EXPECT_EQ(a.rgb[0], b.rgb[0]) << x;
            EXPECT_EQ(a.rgb[1], b.rgb[1]) << x;
            EXPECT_EQ(a.rgb[2], b.rgb[2]) << x;
            EXPECT_EQ(a.ended, b.ended) << x;
            EXPECT_EQ(a.updates, b.updates) << x;
        }
    }
}

// What is under way to one tile is not that of another.
TEST(EarlyBlender, ATileEndsAlone) {
    Bench bench(three_splats(0.5, 0.25, 0.2));
    EarlyBlender pes(bench.job, 4);
    TaskRun other = bench.run_of(1);
    other.tile = 1;
    other.task.row = 5;
    pes.blend(bench.run_of(0), 10);
    pes.blend(other, 11);
    pes.finish(0);
    EXPECT_NEAR(bench.pixel().transmittance, 0.5, kNear);
    EXPECT_EQ(bench.job.path->read_pixel(0, 5, 3).transmittance, 1);
    pes.finish(1);
    EXPECT_NEAR(bench.job.path->read_pixel(0, 5, 3).transmittance, 0.75, kNear);
}

// Parts of a row's tasks at 10, 12, 14 and 16: each pixel comes again after 4 cycles, when it is
// written back. At 17 one pixel of either part comes too early; at 21 nothing is under way but
// those.
TEST(EarlyBlender, CountsPixelsThatComeBeforeTheirWriteBack) {
    Bench bench(std::vector<ProjectedSplat>(6, test::one_row(0, 7, 2, 0.1)));
    EarlyBlender pes(bench.job, 4);
    const std::pair<Cycle, std::uint32_t> parts[] = {{10, 0x0F}, {12, 0xF0}, {14, 0x0F},
                                                     {16, 0xF0}, {17, 0x11}, {21, 0x33}};
    const std::uint64_t hazards[] = {0, 0, 0, 0, 2, 2};
    for (std::uint32_t i = 0; i < 6; ++i) {
        TaskRun run = bench.run_of(i);
        ASSERT_EQ(run.task.mask, 0xFFU);
        run.part = parts[i].second;
        pes.blend(run, parts[i].first);
        EXPECT_EQ(pes.hazards(), hazards[i]) << i;
    }
    TaskRun other = bench.run_of(0); // another row
    other.task.row = 3;
    pes.blend(other, 22);
    EXPECT_EQ(pes.hazards(), 2U);
}

/// One PE for each bank, so that a packet is one task and a pixel comes again in the next cycle.
DegsConfig one_pe_without_scoreboard() {
    DegsConfig config = test::shaped(exact_arithmetic(), {16, 2, 8, 8, 1});
    config.scheduler.scoreboard = false;
    config.scheduler.queue_segments_per_pe = 64;
    config.packing.lead_packets = 40;
    return config;
}

// 40 updates of one pixel in 40 cycles, written back after 4: an update sees the one 4 before it,
// so that only 10 of them are in the pixel at the end. All 39 after the first come too early.
TEST(SmallRunWithoutScoreboard, OneOfFourUpdatesReachesThePixel) {
    std::vector<ProjectedSplat> splats(40, one_pixel(3, 2, 0.02));
    for (ProjectedSplat& splat : splats) {
        splat.colour[0] = 1;
    }
    const FrameWorkload frame = make_frame(splats, 16, 16, 16);
    const DegsConfig config = one_pe_without_scoreboard();
    DegsConfig safe = config;
    safe.scheduler.scoreboard = true;
    const DegsRun early("early", config, {&frame});
    const DegsRun strict("strict", config, {&frame}, Fidelity::Strict);
    const DegsRun kept("kept", safe, {&frame});
    sc_core::sc_start();
    test::expect_sound(early);
    test::expect_reference(kept);
    test::expect_same_statistics(early, strict);
    EXPECT_TRUE(test::same_bytes(early.image(), strict.image()));
    EXPECT_EQ(early.window().cycles(), 40U);
    EXPECT_EQ(early.hazards(), 39U);
    EXPECT_EQ(early.slots()[Slot::Useful], 40U);
    const std::size_t pixel = early.image().at(3, 2);
    EXPECT_NEAR(early.image().transmittance[pixel], std::pow(0.98, 10), 1e-6);
    EXPECT_NEAR(early.image().rgb[3 * pixel], 1 - std::pow(0.98, 10), 1e-6);
    EXPECT_EQ(early.image().fragments[pixel], 40U);
    EXPECT_NEAR(kept.image().transmittance[pixel], std::pow(0.98, 40), 1e-6);
}

// The third update of a chain ends the pixel, and the next three tasks do not know it yet: the
// pixel ends once.
TEST(SmallRunWithoutScoreboard, APixelEndsOnce) {
    const FrameWorkload frame =
        make_frame(std::vector<ProjectedSplat>(40, one_pixel(3, 2, 0.98)), 16, 16, 16);
    const DegsRun run("run", one_pe_without_scoreboard(), {&frame});
    sc_core::sc_start();
    test::expect_sound(run);
    EXPECT_EQ(run.slices(&ArraySlice::Stats::pixels_ended), 1U);
    const std::size_t pixel = run.image().at(3, 2);
    EXPECT_NEAR(run.image().transmittance[pixel], 0.02 * 0.02, 1e-9);
}

} // namespace
} // namespace degs
