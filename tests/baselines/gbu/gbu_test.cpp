// SPDX-License-Identifier: Apache-2.0
// The whole GBU: nothing is lost, the image is right, run-ahead changes nothing.
#include <random>

#include "tests/baselines/gbu/gbu_fixture.hpp"

namespace degs {
namespace {

using test::gbu_of;
using test::GbuRun;
using test::random_frame;

struct GbuShape {
    int tile, engines, row_pes;
};
std::ostream& operator<<(std::ostream& out, const GbuShape& s) {
    return out << s.tile << "px_" << s.engines << "x" << s.row_pes;
}

class SmallRunGbuShape : public ::testing::TestWithParam<GbuShape> {};

TEST_P(SmallRunGbuShape, RendersTheReference) {
    const GbuShape& shape = GetParam();
    const FrameWorkload frame = random_frame(7, 230, 150, shape.tile, 500);
    const GbuRun run("gbu", gbu_of(shape.tile, shape.engines, shape.row_pes), {&frame});
    sc_core::sc_start();
    test::expect_sound(run);
    test::expect_reference(run);
}
INSTANTIATE_TEST_SUITE_P(Points, SmallRunGbuShape,
                         ::testing::Values(GbuShape{16, 1, 8}, GbuShape{16, 1, 16},
                                           GbuShape{32, 2, 32}, GbuShape{64, 4, 64},
                                           GbuShape{128, 8, 128}, GbuShape{20, 3, 7}));

TEST(SmallRunGbu, NoSplatsAtAll) {
    const FrameWorkload frame = test::make_frame({}, 40, 30, 16);
    const GbuRun run("gbu", gbu_of(16, 2, 16), {&frame});
    sc_core::sc_start();
    test::expect_sound(run);
    EXPECT_GT(run.result().cycles, 0U); // the background is written
}

TEST(SmallRunGbu, ACacheSavesReadsAndChangesNoPixel) {
    const FrameWorkload frame = random_frame(9, 200, 160, 16, 300);
    gbu::Config config = gbu_of(16, 2, 16);
    config.reuse_cache.bytes = 0;
    const GbuRun without("without", config, {&frame});
    config.reuse_cache.bytes = 64 * 1024;
    const GbuRun with("with", config, {&frame});
    sc_core::sc_start();
    test::expect_sound(with);
    test::expect_reference(with);
    test::expect_reference(without);
    const auto read = [](const GbuRun& run) {
        std::uint64_t bytes = 0;
        for (const StreamUse& stream : run.result().streams) {
            bytes += stream.name == "splats_read" ? stream.bytes_read : 0;
        }
        return bytes;
    };
    EXPECT_LT(read(with), read(without) / 2);
    const std::uint64_t burst = 64;
    std::uint64_t misses = 0;
    std::uint64_t asked = 0;
    for (const auto& cache : with.gbu().caches()) {
        misses += cache->stats().misses;
        asked += cache->stats().misses + cache->stats().hits;
    }
    EXPECT_EQ(read(with), misses * burst);
    EXPECT_EQ(asked, sum_of(with.gbu().fetchers(), &SplatFetcher::Stats::records));
}

TEST(SmallRunGbu, TheArrayAloneNeedsNoMemoryAndNoFrontEnd) {
    const FrameWorkload frame = random_frame(4, 150, 120, 16, 300);
    BuildOptions alone;
    alone.array_only = true;
    const GbuRun run("gbu", gbu_of(16, 2, 16), {&frame}, Fidelity::Exact, alone);
    const GbuRun whole("whole", gbu_of(16, 2, 16), {&frame});
    sc_core::sc_start();
    test::expect_sound(run);
    test::expect_reference(run);
    EXPECT_LT(run.result().cycles, whole.result().cycles);
    EXPECT_EQ(run.result().slots[Slot::Useful], whole.result().slots[Slot::Useful]);
}

TEST(SmallRunGbu, FramesOverlapAsFarAsTheyMay) {
    std::vector<FrameWorkload> frames;
    for (unsigned f = 0; f < 4; ++f) {
        // A frame of one tile between others: one engine gets nothing of it.
        frames.push_back(f == 2 ? test::make_frame({test::one_pixel(3, 3)}, 90, 60, 16)
                                : random_frame(20 + f, 90, 60, 16, 200));
        frames.back().gaussians = frames.back().splats.size();
    }
    std::vector<const FrameWorkload*> list;
    for (const FrameWorkload& frame : frames) {
        list.push_back(&frame);
    }
    gbu::Config config = gbu_of(16, 3, 16);
    config.frames_in_flight = 1;
    const GbuRun one("one", config, list);
    config.frames_in_flight = 2;
    const GbuRun two("two", config, list);
    config.frames_in_flight = 4;
    const GbuRun four("four", config, list);
    sc_core::sc_start();
    for (const GbuRun* run : {&one, &two, &four}) {
        test::expect_sound(*run);
        test::expect_reference(*run);
        const AcceleratorResult result = run->result();
        ASSERT_EQ(result.frames.size(), 4U);
        for (std::size_t f = 1; f < 4; ++f) {
            EXPECT_GE(result.frames[f].finished, result.frames[f - 1].finished);
        }
        EXPECT_EQ(result.frames.back().finished, result.cycles);
    }
    // Preprocessing of a frame starts when the one that many before has been written.
    EXPECT_GT(one.result().frames[1].preprocessed, one.result().frames[0].finished);
    EXPECT_LT(two.result().frames[1].preprocessed, two.result().frames[0].finished);
    EXPECT_GT(two.result().frames[2].preprocessed, two.result().frames[0].finished);
    EXPECT_LT(two.result().cycles, one.result().cycles);
    EXPECT_LE(four.result().cycles, two.result().cycles);
}

/// A random GBU and random frames.
class RandomGbu {
public:
    explicit RandomGbu(unsigned seed) : random_(seed) {}
    int upto(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
    bool chance(int n) { return upto(n) == 0; }
    int among(std::initializer_list<int> values) {
        return *(values.begin() + upto(static_cast<int>(values.size())));
    }
    gbu::Config config() {
        const int tile = among({16, 16, 32, 24, 64});
        const int engines = 1 + upto(4);
        gbu::Config c = gbu_of(tile, engines, chance(3) ? 1 + upto(tile) : tile);
        c.engines.queue_depth = among({16, 1, 2, 5});
        c.engines.generation_latency = among({8, 0, 3});
        c.engines.row_pe_latency = among({10, 1, 4});
        c.engines.termination_cycles = among({1, 1, 9, 40});
        c.engines.end_probe = !chance(4);
        c.list_buffer.chunks = among({4, 1, 2, 16});
        c.reuse_cache.bytes = among({32768, 0, 1024, 32 * engines});
        c.pixel_buffer.bytes = c.pixel_buffer.bytes / 2 * among({1, 1, 2, 3});
        c.pixel_buffer.readout_pixels = among({64, 1, 1024});
        c.pixel_buffer.writes_in_flight = among({4, 1});
        c.fetching.chunk = among({16, 1, 4});
        c.fetching.chunks_in_flight = among({8, 1, 2});
        c.sorting.count = among({4, 1, 3});
        c.sorting.chunk = among({256, 16, 8});
        c.list_buffer.bytes = among({4, 1, 2}) * c.sorting.count * c.sorting.chunk * 8;
        c.monitor.cancel = !chance(3);
        c.monitor.latency_cycles = among({8, 1, 50});
        c.frames_in_flight = among({2, 1, 3});
        c.tile_order = static_cast<TileOrder>(among({0, 1}));
        c.memory.latency_ns = among({100, 10, 1000});
        return c;
    }
    std::mt19937& random() { return random_; }

private:
    std::mt19937 random_;
};

class SmallRunGbuFidelity : public ::testing::TestWithParam<unsigned> {};

TEST_P(SmallRunGbuFidelity, ExactIsStrict) {
    RandomGbu draw(GetParam());
    const gbu::Config config = draw.config();
    std::vector<FrameWorkload> frames;
    for (int f = draw.chance(3) ? 4 : 1; f > 0; --f) {
        frames.push_back(random_frame(GetParam() * 10 + static_cast<unsigned>(f),
                                      1 + draw.upto(120), 1 + draw.upto(90), config.tile_size,
                                      draw.among({1, 10, 60, 200})));
        frames.back().gaussians = frames.back().splats.size();
    }
    std::vector<const FrameWorkload*> list;
    for (const FrameWorkload& frame : frames) {
        list.push_back(&frame);
    }
    BuildOptions options;
    options.array_only = draw.chance(4);
    const GbuRun exact("exact", config, list, Fidelity::Exact, options);
    const GbuRun strict("strict", config, list, Fidelity::Strict, options);
    sc_core::sc_start();
    test::expect_sound(exact);
    test::expect_reference(exact);
    test::expect_same_statistics(exact, strict);
    for (std::size_t f = 0; f < frames.size(); ++f) {
        EXPECT_EQ(exact.job().images[f].rgb, strict.job().images[f].rgb);
        EXPECT_EQ(exact.job().images[f].transmittance, strict.job().images[f].transmittance);
    }
}

INSTANTIATE_TEST_SUITE_P(Random, SmallRunGbuFidelity, ::testing::Range(0U, 120U));

TEST(HostileGbuConfig, ProblemsAreOneSentenceThatNamesTheKeys) {
    const auto problem = [](void (*change)(gbu::Config&)) {
        gbu::Config config;
        change(config);
        return config.problem();
    };
    EXPECT_EQ(problem([](gbu::Config&) {}), "");
    EXPECT_NE(problem([](gbu::Config& c) { c.engines.row_pes = 33; }).find("engines.row_pes"),
              std::string::npos);
    EXPECT_NE(problem([](gbu::Config& c) { c.pixel_buffer.bytes = 1; }).find("pixel_buffer.bytes"),
              std::string::npos);
    // A context for one engine is not enough for two.
    EXPECT_NE(problem([](gbu::Config& c) {
                  c.pixel_buffer.bytes = 8 * 32 * 32;
              }).find("pixel_buffer.bytes"),
              std::string::npos);
    EXPECT_NE(problem([](gbu::Config& c) { c.list_buffer.bytes = 16; }).find("list_buffer.bytes"),
              std::string::npos);
    EXPECT_NE(problem([](gbu::Config& c) { c.reuse_cache.bytes = 63; }).find("reuse_cache.bytes"),
              std::string::npos);
    EXPECT_EQ(problem([](gbu::Config& c) { c.reuse_cache.bytes = 0; }), "");
}

class RowGenerationCost : public ::testing::TestWithParam<std::pair<int, int>> {};

/// All rows that the engines can solve in the cycles in which they do.
TEST_P(RowGenerationCost, IsThatOfItsBusyCycles) {
    const auto& [engines, rows_per_cycle] = GetParam();
    gbu::Config config = gbu_of(32, engines, 8);
    config.engines.rows_per_cycle = rows_per_cycle;
    const FrameWorkload frame = random_frame(7, 150, 101, 32, 500);
    const GbuRun run("gbu", config, {&frame});
    sc_core::sc_start();
    const AcceleratorResult& result = run.result();
    const double rows = config.bill().block("row_generation").full_rate; // per cycle
    double busy = 0, done = 0, queued = 0;
    for (const StageUse& stage : result.stages) {
        busy += stage.name == "row_generation" ? stage.busy_cycles / stage.units : 0;
    }
    for (const cost::Activity& activity : result.activity) {
        done += activity.block == "row_generation" ? activity.operations : 0;
        queued += activity.block == "row_queues" ? activity.operations : 0;
    }
    // Entries are written and read, also those that a Row PE drops.
    const auto entries = sum_of(run.gbu().engines(), &gbu::TileEngine::Stats::entries);
    const auto dropped = sum_of(run.gbu().engines(), &gbu::TileEngine::Stats::entries_dropped);
    EXPECT_GT(dropped, 0U);
    EXPECT_EQ(queued, static_cast<double>(2 * (entries + dropped) * config.engines.entry_bytes));
    EXPECT_GT(busy, 0.01 * static_cast<double>(result.cycles));
    EXPECT_LE(busy, static_cast<double>(result.cycles));
    EXPECT_NEAR(done, busy * rows, 1e-9 * done);
}

INSTANTIATE_TEST_SUITE_P(Rates, RowGenerationCost,
                         ::testing::Values(std::pair(1, 8), std::pair(8, 1), std::pair(2, 0),
                                           std::pair(2, 4)));

} // namespace
} // namespace degs
