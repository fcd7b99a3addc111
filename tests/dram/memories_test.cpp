// SPDX-License-Identifier: Apache-2.0
// Memories other than LPDDR5: their sizes and peaks, latencies in closed form, and what parts their
// commands from those of LPDDR5: activations of one command, two command buses, slow commands.
#include <random>

#include "tests/dram/fixture.hpp"

namespace degs {
namespace {

using test::ChannelBench;
using test::Command;

/// From the standards' and data sheets' nanoseconds or clocks; shares no code with the files.
struct Memory {
    const char* file;
    double peak_gb_per_s, ck_ns;
    std::uint64_t gib; ///< capacity
    int burst;         ///< CK
    int hit, rcd, rp;
    int cycle; ///< of rows that are read: tRC, or tRCD + tRTP + tRP if that is longer
    int ccd_l;
};

void PrintTo(const Memory& memory, std::ostream* out) {
    *out << memory.file;
}

class Memories : public ::testing::TestWithParam<Memory> {
protected:
    dram::Config config(std::vector<std::string> overrides = {}) const {
        overrides.emplace_back("controller.refresh=none");
        return test::lpddr5_config(GetParam().file, overrides);
    }
    static dram::Ck ck(int count) { return static_cast<dram::Ck>(count); }
};

INSTANTIATE_TEST_SUITE_P(
    Files, Memories,
    ::testing::Values(Memory{"lpddr5x-8533x64", 68.264, 0.9375, 8, 2, 23 + 2, 20, 20, 65, 4},
                      Memory{"lpddr5x-9600x64", 76.8, 0.8333, 8, 2, 26 + 2, 22, 22, 73, 4},
                      Memory{"lpddr6-10667x96", 113.781, 0.375, 16, 6, 56 + 6, 48, 107,
                             48 + 14 + 107, 10},
                      Memory{"ddr5-6400x128", 102.4, 0.3125, 32, 8, 46 + 8, 46, 46, 149, 16},
                      Memory{"gddr6-14000x256", 448, 0.5714, 16, 2, 24 + 2, 27, 27, 80, 4},
                      Memory{"hbm3-6400x1024", 819.2, 0.625, 16, 2, 20 + 2, 31, 26, 72, 4}));

TEST_P(Memories, HaveTheirSizeAndPeak) {
    const dram::Config memory = config();
    EXPECT_NEAR(memory.peak_gb_per_s(), GetParam().peak_gb_per_s, 1e-3);
    EXPECT_NEAR(memory.timing.ck_ns(), GetParam().ck_ns, 1e-4);
    const dram::Mapping mapping(memory.mapping, memory.timing,
                                static_cast<unsigned>(memory.channels));
    EXPECT_EQ(mapping.capacity(), GetParam().gib << 30U);
    EXPECT_EQ(memory.timing.burst(), GetParam().burst);
}

TEST_P(Memories, AnswerClosedOpenAndConflictingRows) {
    ChannelBench bench(config());
    const auto closed = bench.push(100, 3, 7);
    bench.run_out();
    const auto open = bench.push(1000, 3, 7);
    bench.run_out();
    const auto conflict = bench.push(2000, 3, 8);
    bench.run_out();
    EXPECT_EQ(bench.answers[closed], 100 + ck(GetParam().hit + GetParam().rcd));
    EXPECT_EQ(bench.answers[open], 1000 + ck(GetParam().hit));
    EXPECT_EQ(bench.answers[conflict], 2000 + ck(GetParam().hit + GetParam().rcd + GetParam().rp));
}

TEST_P(Memories, RowsOfABankThatAreReadTakeTheirCycleEach) {
    ChannelBench bench(config({"controller.scheduler=fcfs"}));
    const int count = 51;
    for (int i = 0; i < count; ++i) {
        bench.push(10, 5, i % 2 + 1U);
    }
    bench.run_out();
    EXPECT_EQ(bench.answers[count - 1] - bench.answers[0], ck((count - 1) * GetParam().cycle));
}

TEST_P(Memories, OneGroupIsLimitedByTccdLAndGroupsInTurnFillTheBus) {
    for (const bool one_group : {true, false}) {
        ChannelBench bench(config());
        const int count = 401;
        for (int i = 0; i < count; ++i) {
            const unsigned bank = one_group ? i % 4 + 0U : i % 4 * 4U;
            bench.push(10, bank, 9, false, 1, i % 16 + 0U);
        }
        bench.run_out();
        dram::Ck last = 0;
        for (const auto& [id, date] : bench.answers) {
            last = std::max(last, date);
        }
        const int each = one_group ? GetParam().ccd_l : GetParam().burst;
        EXPECT_NEAR(static_cast<double>(last), (count - 1.0) * each,
                    4.0 * GetParam().rcd + GetParam().hit)
            << one_group;
    }
}

/// Random traffic in every bank, rows that hit and rows that do not, reads and writes, refreshes.
ChannelBench& random_traffic(ChannelBench& bench, int banks, unsigned bursts) {
    std::mt19937 random(5);
    dram::Ck date = 0;
    for (int i = 0; i < 6000; ++i) {
        date += test::below(random, 12);
        const unsigned bank = test::below(random, static_cast<unsigned>(banks));
        const unsigned row = test::below(random, 3);
        bench.push(date, bank, row, test::below(random, 3) == 0, bursts, test::below(random, 4));
    }
    bench.run_out();
    return bench;
}

// All commands of a channel in the order of their dates: a bus holds one at a time, a row has one
// activation, and columns find it open.
TEST_P(Memories, CommandsKeepTheirBusAndFindTheirRows) {
    const dram::Config memory = test::lpddr5_config(GetParam().file);
    const dram::Timing& timing = memory.timing;
    ChannelBench bench(memory);
    random_traffic(bench, timing.banks, timing.burst_bytes() == 64 ? 1 : 3);
    EXPECT_EQ(bench.answers.size(), bench.pushed()) << "every access is answered once";
    std::map<bool, dram::Ck> free; // of the bus of columns, and of others, or of the only one
    std::vector<bool> open(timing.banks);
    std::uint64_t together = 0;
    dram::Ck before = 0;
    for (const dram::Issued& issued : bench.trace) {
        const bool column = timing.command_buses == 2 && dram::is_column(issued.command);
        ASSERT_GE(issued.date, free[column]) << dram::command_name(issued.command);
        free[column] = issued.date + static_cast<dram::Ck>(timing.command_ck);
        together += issued.date == before ? 1 : 0;
        before = issued.date;
        if (issued.command == Command::Act1) {
            ASSERT_FALSE(open[issued.bank]);
            open[issued.bank] = true;
        } else if (issued.command == Command::Pre) {
            open[issued.bank] = false;
        } else if (issued.command == Command::PreAb) {
            open.assign(open.size(), false);
        } else if (dram::is_column(issued.command)) {
            ASSERT_TRUE(open[issued.bank]);
        }
    }
    EXPECT_EQ(together != 0, timing.command_buses == 2);
    const auto& commands = bench.channel.stats().commands;
    const auto count = [&](Command c) { return commands[static_cast<std::size_t>(c)]; };
    EXPECT_GT(count(Command::RefAb), 0U);
    EXPECT_EQ(count(Command::Act2), timing.act_commands == 2 ? count(Command::Act1) : 0);
}

// Gaps that other DRAMs have where LPDDR5 has one for all.
TEST(MemoryRules, KeysPartGapsThatLpddr5HasInCommon) {
    const dram::Config memory = test::lpddr5_config("ddr5-6400x128");
    const dram::RuleTable rules(memory.timing);
    const auto gap = [&](Command first, Command second, unsigned bank) {
        dram::Dates dates(rules);
        dates.issue(first, 5, 1000);
        return dates.earliest(second, bank) - 1000;
    };
    EXPECT_EQ(gap(Command::Act1, Command::Act1, 6), 16U) << "tRRD_L";
    EXPECT_EQ(gap(Command::Act1, Command::Act1, 30), 8U) << "tRRD_S";
    EXPECT_EQ(gap(Command::Rd, Command::Rd, 6), 16U) << "tCCD_L";
    EXPECT_EQ(gap(Command::Rd, Command::Rd, 31), 8U) << "tCCD_S";
    EXPECT_EQ(gap(Command::Wr, Command::Wr, 6), 64U) << "tCCD_L_WR";
    EXPECT_EQ(gap(Command::Wr, Command::Rd, 6), 44U + 8 + 32) << "tWTR_L";
    EXPECT_EQ(gap(Command::Wr, Command::Rd, 31), 44U + 8 + 8) << "tWTR_S";
    EXPECT_EQ(gap(Command::Rd, Command::Wr, 31), 14U) << "tRTW";
    const dram::RuleTable graphics(test::lpddr5_config("gddr6-14000x256").timing);
    dram::Dates dates(graphics);
    dates.issue(Command::Act1, 5, 1000);
    EXPECT_EQ(dates.earliest(Command::Rd, 5), 1027U);
    EXPECT_EQ(dates.earliest(Command::Wr, 5), 1016U);
}

TEST(MemoryRules, RejectsWhatCannotBe) {
    for (const char* wrong :
         {"timing.pins=24", "timing.beats_per_ck=3", "timing.banks=24", "timing.page_bytes=3000",
          "timing.burst_length=12", "timing.burst_data_bytes=64", "timing.command_buses=3"}) {
        EXPECT_THROW(test::lpddr5_config("lpddr5-6400x256", {wrong}), InputError) << wrong;
    }
    EXPECT_THROW(test::lpddr5_config("lpddr5-3200x128", {"timing.banks=32"}), InputError);
}

} // namespace
} // namespace degs
