// SPDX-License-Identifier: Apache-2.0
// What a run left out: every sentence of every accelerator, with the counter that it quotes.
#include <gmock/gmock.h>

#include "base/grouped_number.hpp"
#include "baselines/gbu/config.hpp"
#include "baselines/gcc/config.hpp"
#include "baselines/gscore/config.hpp"
#include "modules/degs/config.hpp"
#include "tests/baselines/engine_run.hpp"

namespace degs {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::Matcher;
using ::testing::Not;
using ::testing::StartsWith;

class SmallRunExplanation : public ::testing::Test {
protected:
    template <class Config>
    void run(const Config& config, const BuildOptions& options = {}) {
        // Opaque splats in a crowd: what can be left out is.
        const FrameWorkload frame = test::random_frame(7, 150, 90, config.tile_size_px(), 900);
        const test::EngineRun run("engine", config, {&frame}, Fidelity::Exact, options);
        sc_core::sc_start();
        result = run.result();
    }
    std::uint64_t count(const std::string& stage, const std::string& name) const {
        for (const StageUse& use : result.stages) {
            for (const Counters::Counter& counter : use.counters) {
                if (use.name == stage && counter.doc.name == name) {
                    return counter.value;
                }
            }
        }
        ADD_FAILURE() << stage << '.' << name << " is not in the result";
        return 0;
    }
    static Matcher<std::string> sentence(std::uint64_t number, const std::string& rest) {
        return StartsWith(grouped(number) + rest);
    }
    /// What all accelerators say of the bus and of their tiles, then `own`.
    void expect(std::uint64_t records_cancelled, const std::vector<Matcher<std::string>>& own) {
        std::vector<Matcher<std::string>> all{
            HasSubstr("banks, rows and refresh are not modelled"),
            StartsWith("Only what is written to the frame buffer exists as bytes"),
            sentence(result.background_tiles, " of " +
                                                  grouped(result.tiles + result.background_tiles) +
                                                  " tiles list no splat"),
            AllOf(sentence(result.tiles_cancelled, " tiles were cancelled before the end"),
                  HasSubstr(": " + grouped(records_cancelled) + " splat records")),
        };
        all.insert(all.end(), own.begin(), own.end());
        EXPECT_THAT(result.left_out, ElementsAreArray(all));
    }
    AcceleratorResult result;
};

TEST_F(SmallRunExplanation, Degs) {
    run(DegsConfig());
    expect(count("fetching", "records_cancelled"),
           {sentence(count("slicing", "splats_cancelled"), " splats of cancelled tiles"),
            sentence(count("packing", "tasks_dropped"), " tasks of ended pixels were dropped"),
            sentence(count("span", "empty_rows"), " rows of splats cover no pixel"),
            StartsWith("Every SRAM had as many ports as anybody wanted")});
    EXPECT_GT(count("packing", "tasks_dropped"), 0U);
    EXPECT_GT(result.tiles_cancelled, 0U);
}

TEST_F(SmallRunExplanation, TakenPorts) {
    DegsConfig config;
    config.pixel_buffer.ports.ports = 1;
    config.pixel_buffer.ports.sram_banks = 8;
    run(config);
    EXPECT_GT(result.slots[Slot::Ports], 0U);
    EXPECT_THAT(result.left_out,
                Contains(StartsWith("Taken SRAM ports left " + grouped(result.slots[Slot::Ports]) +
                                    " PE-cycles")));
    EXPECT_THAT(result.left_out, Not(Contains(StartsWith("Every SRAM had"))));
}

TEST_F(SmallRunExplanation, Gscore) {
    run(gscore::Config());
    expect(count("fetching", "records_cancelled"),
           {sentence(count("blending", "splats_skipped"), " splats took no slot"),
            sentence(count("blending", "splats_discarded"), " splats had been fetched when")});
    EXPECT_GT(count("blending", "splats_skipped"), 0U);
}

TEST_F(SmallRunExplanation, Gbu) {
    run(gbu::Config());
    expect(count("fetching", "records_cancelled"),
           {AllOf(sentence(count("row_generation", "rows_skipped"), " rows of splats were left"),
                  HasSubstr(" and " + grouped(count("row_pes", "entries_dropped")) +
                            " row entries dropped"))});
    EXPECT_GT(count("row_generation", "rows_skipped"), 0U);
}

TEST_F(SmallRunExplanation, Gcc) {
    gcc::Config config;
    config.view_size = 32;
    config.image_buffer.bytes = 32 * 32 * config.image_buffer.state_bytes;
    run(config);
    expect(count("projection", "entries_cancelled"),
           {sentence(count("colour", "masked"), " projected Gaussians could only reach ended"),
            sentence(count("blending", "windows_ended"), " windows were passed"),
            sentence(count("blending", "splats_dropped"), " splats reached the array after all")});
    EXPECT_GT(count("blending", "windows_ended"), 0U);
}

TEST_F(SmallRunExplanation, Lpddr5SaysWhatItLeavesOutItself) {
    DegsConfig config;
    config.memory.model = MemoryModel::Lpddr5;
    run(config);
    EXPECT_TRUE(result.row_hit_rate.has_value());
    EXPECT_THAT(result.left_out, Contains(StartsWith("The memory is LPDDR5 with channels, banks")));
    EXPECT_THAT(result.left_out, Contains(StartsWith("The energy of the memory is that of its")));
    EXPECT_THAT(result.left_out, Not(Contains(HasSubstr("row hit rate"))));
}

TEST_F(SmallRunExplanation, AnArrayAloneHasUnlimitedMemory) {
    BuildOptions options;
    options.array_only = true;
    run(DegsConfig(), options);
    EXPECT_EQ(result.memory_gb_per_s, 0);
    EXPECT_THAT(result.left_out, Contains(StartsWith("The array runs alone")));
    EXPECT_THAT(result.left_out, Not(Contains(HasSubstr("shared data bus"))));
}

} // namespace
} // namespace degs
