// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include <gtest/gtest.h>

#include "modules/kit/accelerator/waiting_causes.hpp"
#include "sim/accelerator/accelerator_run.hpp"
#include "sim/report/terminal.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

TEST(Words, Grouped) {
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1 000");
    EXPECT_EQ(grouped(210422), "210 422");
    EXPECT_EQ(grouped(~std::uint64_t{0}), "18 446 744 073 709 551 615");
}

TEST(Words, ThreeDigits) {
    EXPECT_EQ(three_digits(0), "0");
    EXPECT_EQ(three_digits(2.1084), "2.11");
    EXPECT_EQ(three_digits(473.9), "474");
    EXPECT_EQ(three_digits(51234), "51200");
    EXPECT_EQ(three_digits(0.000386), "0.000386");
    EXPECT_EQ(three_digits(9.999), "10.0");
    EXPECT_EQ(three_digits(99.96), "100");
    EXPECT_EQ(three_digits(-0.5), "-0.500");
}

TEST(Words, DecimalOfIsTheOneThatWasMeant) {
    EXPECT_EQ(decimal_of(0.1 + 0.2), "0.3");
    EXPECT_EQ(decimal_of(204.79999999999998), "204.8");
    EXPECT_EQ(decimal_of(0.00752206900000001), "0.007522069");
    double sum = 0;
    for (int i = 0; i < 30; ++i) {
        sum += 0.3141;
    }
    EXPECT_EQ(decimal_of(sum), "9.423");
    EXPECT_EQ(decimal_of(-2.1780000000000004), "-2.178");
    EXPECT_EQ(decimal_of(0), "0");
    EXPECT_EQ(decimal_of(12345.678901234 + 1e-12), "12345.678901234");
}

TEST(Words, DecimalOfReadsBackWhereNothingShorterWasMeant) {
    for (const double value : {1.0 / 3, 2e9 / 7, 3.14159265358979312, 1e-300 / 7, 1 - 0x1p-40}) {
        EXPECT_EQ(std::stod(decimal_of(value)), value);
    }
}

TEST(Words, Scaled) {
    EXPECT_EQ(scaled(0.0), "0");
    EXPECT_EQ(scaled(999.4), "999");
    EXPECT_EQ(scaled(999.6), "1.00 k");
    EXPECT_EQ(scaled(1000.0), "1.00 k");
    EXPECT_EQ(scaled(54512345.0), "54.5 M");
    EXPECT_EQ(scaled(1e18), "1000000 T");
    EXPECT_EQ(percent(0.8336), "83.4");
    EXPECT_EQ(percent(0.5, 0), "50");
}

TEST(Words, TimesHaveTwoUnits) {
    EXPECT_EQ(time_words(59.4), "59 s");
    EXPECT_EQ(time_words(61), "1 min 1 s");
    EXPECT_EQ(time_words(3600), "1 h 0 min");
    EXPECT_EQ(time_words(2 * 3600 + 5 * 60 + 59), "2 h 5 min");
}

TEST(Words, Progress) {
    EXPECT_EQ(progress_line("loading x.ply", 3.2, 0), "loading x.ply · 3 s");
    EXPECT_EQ(progress_line("simulation", 10, 0.25), "simulation 25 % · 10 s, about 30 s to go");
    EXPECT_EQ(progress_line("simulation", 10, 1), "simulation 100 % · 10 s, about 0 s to go");
}

TEST(Words, LayoutAlignsTheSecondColumn) {
    EXPECT_EQ(layout({{"a", "x"}, {"long", "y"}}), "a     x\nlong  y\n");
}

AcceleratorResult lawful() {
    AcceleratorResult result;
    result.pes = 4;
    result.window.include(10);
    result.window.include(12);
    result.slots[Slot::Useful] = 5;
    result.slots[Slot::Drain] = 7; // 4 PEs x 3 cycles in all
    result.conservation = {{"in = out", 9, 9}};
    result.tiles = result.tiles_listed = 2;
    return result;
}

std::string broken_law(const AcceleratorResult& result) {
    try {
        check_result(result);
    } catch (const std::logic_error& error) {
        return error.what();
    }
    return "";
}

TEST(Laws, BreachesAreNamed) {
    EXPECT_EQ(broken_law(lawful()), "");
    AcceleratorResult result = lawful();
    result.slots[Slot::Useful]++;
    EXPECT_NE(broken_law(result).find("13 is not 12"), std::string::npos);
    result = lawful();
    result.unbilled = {"accelerator.queue_0 of 16 cells"};
    EXPECT_NE(broken_law(result).find("stands for accelerator.queue_0 of 16 cells"),
              std::string::npos);
    result = lawful();
    result.conservation[0].right = 8;
    EXPECT_NE(broken_law(result).find("in = out"), std::string::npos);
    result = lawful();
    result.tiles = 1;
    result.stopped = 777;
    EXPECT_NE(broken_law(result).find("deadlocked"), std::string::npos);
    EXPECT_NE(broken_law(result).find("777 and 1 of 2 tiles"), std::string::npos);
}

TEST(SteadyFps, IsOfAllFramesButTheFirstAndTheLast) {
    AcceleratorResult result;
    result.clock_ghz = 2;
    EXPECT_FALSE(steady_fps(result));
    result.frames = {{0, 1000}};
    EXPECT_FALSE(steady_fps(result));
    result.frames = {{0, 1000}, {0, 1400}};
    EXPECT_FALSE(steady_fps(result));
    result.frames = {{0, 1000}, {0, 1400}, {0, 2000}, {0, 2100}};
    EXPECT_DOUBLE_EQ(steady_fps(result).value(), 4e6); // 2 frames in 1000 cycles of 0.5 ns
}

/// A run of 100 cycles of 10 PEs, of which `before` pass before the first task, and in which the
/// bus is busy while the array works.
AcceleratorResult run_on_memory(Cycle before, std::uint64_t starved) {
    AcceleratorResult result;
    result.pes = 10;
    result.cycles = result.memory_window = 100;
    result.window.include(before);
    result.window.include(99);
    result.slots[Slot::Starved] = starved;
    result.slots[Slot::Useful] = 10 * (100 - before) - starved;
    result.memory_gb_per_s = 10;
    result.memory_utilization = 1;
    result.streams.resize(2);
    result.streams[0].prepares = 1;
    result.streams[0].bytes_read = 10 * before;
    result.streams[1].bytes_read = 10 * (100 - before);
    result.stages = {{"projection", "", false, 1, 0.5 * static_cast<double>(before), 0.2, {}, 1},
                     {"blending", "", true, 10, 10.0 * static_cast<double>(100 - before), 0.9, {}}};
    return result;
}

TEST(WaitingCauses, CountWhatWasLostForMemory) {
    AcceleratorResult result = run_on_memory(40, 200);
    EXPECT_DOUBLE_EQ(WaitingCauses(result).lost_for_memory().value(), 0.6);
    EXPECT_EQ(WaitingCauses(result).starved_for(), "memory");
    result.slots[Slot::Blocked] = 50;
    EXPECT_DOUBLE_EQ(WaitingCauses(result).lost_for_memory().value(), 0.65);
    result.stages[0].busy_cycles = 41; // longer than the bytes take
    EXPECT_FALSE(WaitingCauses(result).prepares_for_memory());
    EXPECT_DOUBLE_EQ(WaitingCauses(result).lost_for_memory().value(), 0.25);
    result.stages[0].busy_cycles = 1;
    result.binning_cycles = 41;
    EXPECT_FALSE(WaitingCauses(result).prepares_for_memory());
    result.memory_gb_per_s = 0;
    EXPECT_FALSE(WaitingCauses(result).lost_for_memory());
}

TEST(LimitingStage, IsMemoryIfMoreThanHalfIsLostForIt) {
    AcceleratorResult result = run_on_memory(40, 101);
    EXPECT_EQ(limiting_stage(result), "memory");
    result = run_on_memory(40, 99);
    EXPECT_EQ(limiting_stage(result), "blending");
    result = run_on_memory(40, 600);
    result.memory_utilization = 0.5; // the bus is busier than any stage only before the first task
    result.stages[1].busy = 0.4;
    EXPECT_EQ(limiting_stage(result), "blending");
    result = run_on_memory(10, 99);
    result.stages[1].busy_cycles = 850; // 94 % of the time of ten units, and the bus all of it
    EXPECT_EQ(limiting_stage(result), "memory");
    result.stages[1].busy_cycles = 900;
    EXPECT_EQ(limiting_stage(result), "blending");
    result.stages.clear();
    EXPECT_EQ(limiting_stage(result), "");
}

} // namespace
} // namespace degs::sim
