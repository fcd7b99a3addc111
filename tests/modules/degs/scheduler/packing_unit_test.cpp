// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/scheduler/packing_unit.hpp"

#include <gtest/gtest.h>

#include "tests/tlm/script.hpp"

namespace degs {
namespace {

using test::Script;

constexpr Cycle kLatency = 2;

TaskRun run_of(std::uint32_t mask, std::int16_t row = 0, TileNumber tile = 0) {
    TaskRun run;
    run.task.mask = mask;
    run.task.row = row;
    run.tile = tile;
    return run;
}

/// A Packing Unit of four tasks per packet, a bank that drives it and an array that listens.
struct PackingBench {
    struct Got {
        Cycle date;
        TaskPacket packet;
    };
    Timebase time;
    PackingUnit unit;
    DatedFifo<TaskPacket> ring{"ring", time, 12, kLatency};
    Process bank{time};
    Process array{time};
    std::vector<Got> got;
    std::unique_ptr<Script> driver, listener;

    explicit PackingBench(bool reorganisation = true, const PacketPorts::Config& ports = {},
                          int packets_per_cycle = 64)
        : unit("unit", config_of(reorganisation, ports, packets_per_cycle)) {
        unit.out.bind(ring);
    }
    static PackingUnit::Config config_of(bool reorganisation, const PacketPorts::Config& ports,
                                         int packets_per_cycle) {
        PackingUnit::Config config;
        config.width = 4;
        config.latency_cycles = static_cast<int>(kLatency);
        config.depth = 8;
        config.reorganisation = reorganisation;
        config.ports = ports;
        config.packets_per_cycle = packets_per_cycle;
        return config;
    }
    void drive(const std::function<void()>& body) {
        ring.connect_writer(bank);
        driver = std::make_unique<Script>("driver", [this, body] {
            body();
            bank.finish();
        });
        listener = std::make_unique<Script>("listener", [this] {
            for (;;) {
                const TaskPacket packet = ring.get(array);
                got.push_back({array.local(), packet});
                array.advance(packet.tasks != 0 ? 1 : 0);
            }
        });
        sc_core::sc_start();
    }
    Cycle add(const TaskRun& run) { return unit.add(bank, run, run.task.mask); }
    /// What the bank does at the end of a cycle.
    void next_cycle(Cycle until) {
        unit.send_due(bank, Slot::Conflict);
        unit.close_cycles(bank, until, Slot::Conflict);
        bank.advance_to(until);
    }
    /// What the bank does at the end of every cycle until then.
    void next_cycles(Cycle until) {
        while (bank.local() < until) {
            next_cycle(bank.local() + 1);
        }
    }
};

int bits(std::uint32_t mask) {
    return __builtin_popcount(mask);
}

TaskRun run_of_splat(std::uint32_t splat, std::uint32_t mask, std::int16_t row) {
    TaskRun run = run_of(mask, row);
    run.task.splat = splat;
    return run;
}

// Segments of 3, 6, 1 and 2 tasks: 12 tasks, 3 packets of 4, nothing reordered.
TEST(PackingUnit, CompactsSegmentsInOrder) {
    PackingBench bench;
    const std::uint32_t masks[] = {0xE0, 0x3F00, 0x1, 0x30000};
    bench.drive([&] {
        bench.bank.advance(10);
        Cycle last[4];
        for (std::int16_t i = 0; i < 4; ++i) {
            last[i] = bench.add(run_of(masks[i], i));
        }
        EXPECT_EQ(last[0], 12U); // execution date of the last task of each segment
        EXPECT_EQ(last[1], 14U); // 1 + 4 + 1
        EXPECT_EQ(last[2], 14U);
        EXPECT_EQ(last[3], 14U);
        bench.next_cycle(11);
    });
    ASSERT_EQ(bench.got.size(), 3U);
    std::vector<std::pair<int, int>> tasks; // row and bit of every task in the order of execution
    for (std::size_t p = 0; p < 3; ++p) {
        const TaskPacket& packet = bench.got[p].packet;
        EXPECT_EQ(bench.got[p].date, 10 + kLatency + p);
        EXPECT_EQ(packet.slot, bench.got[p].date);
        EXPECT_EQ(packet.tasks, 4);
        for (int r = 0; r < packet.run_count; ++r) {
            const TaskRun& run = packet.runs[static_cast<std::size_t>(r)];
            for (int bit = 0; bit < 32; ++bit) {
                if ((run.part >> bit & 1U) != 0) {
                    tasks.emplace_back(run.task.row, bit);
                }
            }
        }
    }
    std::vector<std::pair<int, int>> expected;
    for (int row = 0; row < 4; ++row) {
        for (int bit = 0; bit < 32; ++bit) {
            if ((masks[row] >> bit & 1U) != 0) {
                expected.emplace_back(row, bit);
            }
        }
    }
    EXPECT_EQ(tasks, expected);
    EXPECT_EQ(bench.unit.stats().packets, 3U);
    EXPECT_EQ(bench.unit.stats().tasks, 12U);
    EXPECT_EQ(bench.unit.idle().total(), 0U);
}

// A packet that is not full waits for company as long as the array is busy, and goes in time.
TEST(PackingUnit, AnOpenPacketGoesWhenItsSlotComes) {
    PackingBench bench;
    bench.drive([&] {
        EXPECT_EQ(bench.unit.packet().open_until(), kNever);
        EXPECT_EQ(bench.add(run_of(0xFFF)), kLatency + 2); // slots 2, 3, 4
        EXPECT_EQ(bench.unit.packet().next_execution(0), 5U);
        bench.add(run_of(0x1)); // opens slot 5
        EXPECT_EQ(bench.unit.packet().open_until(), 3U);
        EXPECT_FALSE(bench.unit.packet().due(2));
        EXPECT_TRUE(bench.unit.packet().due(3));
        bench.next_cycle(2);
        EXPECT_EQ(bench.add(run_of(0x2)), 5U); // joins
        bench.next_cycle(3);
        bench.next_cycle(9);
        EXPECT_EQ(bench.unit.packet().open_until(), kNever);
        EXPECT_EQ(bench.unit.packet().next_execution(9), 9 + kLatency);
        bench.add(run_of(0xF));
        bench.next_cycle(10);
    });
    ASSERT_EQ(bench.got.size(), 5U);
    EXPECT_EQ(bench.got[3].date, 5U);
    EXPECT_EQ(bench.got[3].packet.tasks, 2);
    EXPECT_EQ(bench.got[3].packet.run_count, 2);
    EXPECT_EQ(bench.got[4].date, 11U);
    // Two empty places in slot 5, nothing in slots 6 to 10.
    EXPECT_EQ(bench.unit.idle()[Slot::Conflict], 2U + 5 * 4);
    EXPECT_EQ(bench.unit.idle().total(), 2U + 5 * 4);
}

// Slots after the last packet are the drain's, not the unit's.
TEST(PackingUnit, NothingIsIdleAfterTheLastPacket) {
    PackingBench bench;
    bench.drive([&] {
        bench.next_cycle(50);
        bench.add(run_of(0xF));
        bench.next_cycle(90);
    });
    EXPECT_EQ(bench.got.size(), 1U);
    EXPECT_EQ(bench.unit.idle().total(), 0U); // neither before the first
}

// depth 8 packets of 4 tasks: room counts what waits behind the pipeline.
TEST(PackingUnit, RoomIsTheBufferMinusWhatIsQueued) {
    PackingBench bench;
    bench.drive([&] {
        EXPECT_TRUE(bench.unit.room(0, run_of(1), 32));
        EXPECT_FALSE(bench.unit.room(0, run_of(1), 33));
        bench.add(run_of(0xFFFFFF)); // 6 packets, slots 2 to 7
        for (int now = 0; now < 12; ++now) {
            const int queued = std::max(6 - now, 0);
            EXPECT_TRUE(bench.unit.room(now, run_of(1), 4 * (8 - queued))) << now;
            EXPECT_FALSE(bench.unit.room(now, run_of(1), 4 * (8 - queued) + 1)) << now;
            bench.next_cycle(now + 1);
        }
    });
    EXPECT_EQ(bench.got.size(), 6U);
}

class PacketWrites : public ::testing::TestWithParam<int> {};

// A segment of 15 tasks completes three packets of four. With P writes per cycle they are written
// in the cycles up to ceil(3 / P) - 1; until then only tasks may follow that complete no more than
// the cycle can write beside them.
TEST_P(PacketWrites, LetNothingPassThatCannotBeWritten) {
    const int writes = GetParam();
    PackingBench bench(true, {}, writes);
    bench.drive([&] {
        EXPECT_TRUE(bench.unit.room(0, run_of(1), 15)) << "nothing waits";
        bench.add(run_of(0x7FFF));
        for (int now = 0; now < 5; ++now) {
            const int waiting = std::max(3 - now * writes, 0);
            for (int tasks = 1; tasks < 9; ++tasks) {
                const int complete = (3 + tasks) / 4; // three tasks are in the open packet
                EXPECT_EQ(bench.unit.room(now, run_of(1), tasks),
                          waiting == 0 || waiting + complete <= writes)
                    << tasks << " tasks in cycle " << now;
            }
            EXPECT_TRUE(bench.unit.room(now, run_of(1), 0)) << "a segment whose pixels have ended";
            bench.next_cycle(now + 1);
        }
    });
    ASSERT_EQ(bench.got.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(bench.got[i].date, kLatency + i) << "the array never waits for a write";
    }
}

INSTANTIATE_TEST_SUITE_P(PerCycle, PacketWrites, ::testing::Values(1, 2, 3, 4, 64));

/// Single tasks of two rows, of one row and two splats, and of one span in two segments; then six
/// tasks of one span and one of another.
std::vector<TaskRun> seven_runs() {
    return {run_of_splat(0, 1, 0), run_of_splat(0, 1, 1), run_of_splat(1, 1, 1),
            run_of_splat(1, 2, 1), run_of_splat(1, 4, 0), run_of_splat(2, 0x3F, 0),
            run_of_splat(3, 1, 0)};
}

std::vector<int> tasks_of(const std::vector<PackingBench::Got>& got) {
    std::vector<int> tasks;
    for (const PackingBench::Got& one : got) {
        tasks.push_back(one.packet.tasks);
    }
    return tasks;
}

TEST(PackingUnit, CompactsSpans) {
    PackingBench bench;
    bench.drive([&] {
        for (const TaskRun& run : seven_runs()) {
            bench.add(run);
        }
        bench.next_cycle(9);
    });
    EXPECT_EQ(tasks_of(bench.got), (std::vector<int>{4, 4, 4}));
    EXPECT_EQ(bench.unit.idle().total(), 0U);
}

// 12 tasks of six spans, one of which is longer than a packet: seven packets in place of three.
TEST(PackingUnit, WithoutReorganisationAPacketHasTasksOfOneSpan) {
    PackingBench bench(false);
    bench.drive([&] {
        std::vector<Cycle> last;
        for (const TaskRun& run : seven_runs()) {
            last.push_back(bench.add(run));
        }
        EXPECT_EQ(last, (std::vector<Cycle>{2, 3, 4, 4, 5, 7, 8}));
        bench.next_cycles(9);
    });
    EXPECT_EQ(tasks_of(bench.got), (std::vector<int>{1, 1, 2, 1, 4, 2, 1}));
    for (std::size_t p = 0; p < bench.got.size(); ++p) {
        EXPECT_EQ(bench.got[p].date, kLatency + p);
        const TaskPacket& packet = bench.got[p].packet;
        for (int r = 1; r < packet.run_count; ++r) {
            EXPECT_EQ(packet.runs[r].task.splat, packet.runs[0].task.splat);
            EXPECT_EQ(packet.runs[r].task.row, packet.runs[0].task.row);
        }
    }
    // Tasks of other spans waited behind the first six packets; the last one left at its date.
    EXPECT_EQ(bench.unit.idle()[Slot::Blocked], 3U + 3 + 2 + 3 + 0 + 2);
    EXPECT_EQ(bench.unit.idle()[Slot::Conflict], 3U);
}

// A packet that another span closes counts as a full one.
TEST(PackingUnit, WithoutReorganisationRoomIsThatOfWholePackets) {
    PackingBench bench(false);
    bench.drive([&] {
        bench.add(run_of_splat(0, 1, 0));
        EXPECT_TRUE(bench.unit.room(0, run_of_splat(0, 0, 0), 31));
        EXPECT_FALSE(bench.unit.room(0, run_of_splat(0, 0, 0), 32));
        EXPECT_TRUE(bench.unit.room(0, run_of_splat(1, 0, 0), 28));
        EXPECT_FALSE(bench.unit.room(0, run_of_splat(1, 0, 0), 29));
        for (std::uint32_t splat = 1; splat < 8; ++splat) {
            EXPECT_TRUE(bench.unit.room(0, run_of_splat(splat, 0, 0), 1));
            bench.add(run_of_splat(splat, 1, 0));
        }
        EXPECT_FALSE(bench.unit.room(0, run_of_splat(8, 0, 0), 1));
        EXPECT_TRUE(bench.unit.room(0, run_of_splat(7, 0, 0), 3));
        bench.next_cycles(9);
    });
    EXPECT_EQ(bench.got.size(), 8U);
}

// An end of tile rides on the open packet that holds the tile's last tasks, or travels alone and
// costs the array no cycle.
TEST(PackingUnit, EndsOfTilesCostNothing) {
    PackingBench bench;
    bench.drive([&] {
        bench.unit.end_tile(bench.bank, 0, 0); // alone
        bench.add(run_of(0x3, 0, 1));
        bench.unit.end_tile(bench.bank, 1, 0); // with its tasks
        bench.add(run_of(0x4, 0, 2));
        bench.unit.end_tile(bench.bank, 2, 0); // the open packet has an end already
        bench.next_cycle(1);
    });
    ASSERT_EQ(bench.got.size(), 3U);
    EXPECT_EQ(bench.got[0].packet.tasks, 0);
    EXPECT_EQ(bench.got[1].packet.tasks, 3);
    EXPECT_EQ(bench.got[2].packet.tasks, 0);
    for (TileNumber i = 0; i < 3; ++i) {
        EXPECT_TRUE(bench.got[i].packet.ends_tile);
        EXPECT_EQ(bench.got[i].packet.ended_tile, i);
    }
    EXPECT_EQ(bench.got[1].date, kLatency);
    EXPECT_EQ(bits(bench.got[1].packet.runs[1].part), 1);
}

/// Ports of the Pixel Buffer, or of the Feature Buffer, on tiles of 16 px that one bank has alone.
PacketPorts::Config pixel_ports(int ports, int sram_banks) {
    PacketPorts::Config config;
    config.tile_size = 16;
    config.banks = 1;
    config.pixels.ports = ports;
    config.pixels.sram_banks = sram_banks;
    return config;
}
PacketPorts::Config feature_ports(int ports, int sram_banks) {
    PacketPorts::Config config;
    config.features.ports = ports;
    config.features.sram_banks = sram_banks;
    return config;
}

/// Adds one run after the other at cycle 0; returns the tasks of every packet.
std::vector<int> packets_of(const PacketPorts::Config& ports,
                            const std::vector<std::pair<TaskRun, int>>& runs) {
    PackingBench bench(true, ports);
    bench.drive([&] {
        for (const auto& [run, entry] : runs) {
            EXPECT_TRUE(bench.unit.room_by_ports(0, run, run.task.mask, entry));
            bench.unit.add(bench.bank, run, run.task.mask, entry);
        }
        bench.next_cycles(20);
    });
    std::vector<int> tasks;
    for (const auto& got : bench.got) {
        EXPECT_EQ(got.date, kLatency + tasks.size());
        tasks.push_back(got.packet.tasks);
    }
    return tasks;
}

// Eight tasks, all of the pixels 0 of their rows: in four SRAM banks these lie in the same one.
class PixelPorts : public ::testing::TestWithParam<std::tuple<int, int, std::size_t>> {};

TEST_P(PixelPorts, TasksOfOneSramBankTakeACycleEach) {
    const auto [ports, sram_banks, packets] = GetParam();
    std::vector<std::pair<TaskRun, int>> runs;
    for (std::int16_t row = 0; row < 8; ++row) {
        runs.emplace_back(run_of(0x1, row), 0);
    }
    const std::vector<int> tasks = packets_of(pixel_ports(ports, sram_banks), runs);
    EXPECT_EQ(tasks, std::vector<int>(packets, static_cast<int>(8 / packets)));
}

// Four tasks per packet at most. 64 SRAM banks hold four rows of 16 px.
INSTANTIATE_TEST_SUITE_P(Ports, PixelPorts,
                         ::testing::Values(std::tuple(0, 4, 2), std::tuple(1, 4, 8),
                                           std::tuple(2, 4, 4), std::tuple(4, 4, 2),
                                           std::tuple(1, 32, 4), std::tuple(1, 64, 2)));

// Neighbours lie in different SRAM banks; a segment is cut where a bank comes again.
TEST(PackingPorts, ASegmentIsCutWhereAnSramBankComesAgain) {
    EXPECT_EQ(packets_of(pixel_ports(1, 3), {{run_of(0xFF), 0}}), (std::vector<int>{3, 3, 2}));
}

TEST(PackingPorts, TwoTasksAtADistanceOfAllSramBanks) {
    EXPECT_EQ(packets_of(pixel_ports(1, 4), {{run_of(0x11), 0}}), (std::vector<int>{1, 1}));
}

TEST(PackingPorts, EveryTileContextHasSramBanksOfItsOwn) {
    TaskRun other = run_of(0x1);
    other.task.context = 1;
    EXPECT_EQ(packets_of(pixel_ports(1, 4), {{run_of(0x1), 0}, {other, 0}}), (std::vector<int>{2}));
}

// Eight tasks of eight splats; the parameters of entries 0, 2, 4, ... lie in one of two SRAM banks.
class FeaturePorts : public ::testing::TestWithParam<std::tuple<int, int, int, std::size_t>> {};

TEST_P(FeaturePorts, SplatsOfOneSramBankTakeACycleEach) {
    const auto [ports, sram_banks, step, packets] = GetParam();
    std::vector<std::pair<TaskRun, int>> runs;
    for (std::int16_t i = 0; i < 8; ++i) {
        runs.emplace_back(run_of(0x1, i), i * step);
    }
    const std::vector<int> tasks = packets_of(feature_ports(ports, sram_banks), runs);
    EXPECT_EQ(tasks, std::vector<int>(packets, static_cast<int>(8 / packets)));
}

// A step of 0: all tasks are of one splat and share a read.
INSTANTIATE_TEST_SUITE_P(Ports, FeaturePorts,
                         ::testing::Values(std::tuple(0, 1, 1, 2), std::tuple(1, 1, 1, 8),
                                           std::tuple(2, 1, 1, 4), std::tuple(1, 1, 0, 2),
                                           std::tuple(1, 2, 1, 4), std::tuple(1, 2, 2, 8),
                                           std::tuple(1, 4, 1, 2)));

// Slots that a taken port leaves empty are counted as such.
TEST(PackingPorts, EmptySlotsHaveACauseOfTheirOwn) {
    PackingBench bench(true, pixel_ports(1, 4));
    bench.drive([&] {
        bench.add(run_of(0x1, 0));
        bench.add(run_of(0x1, 1)); // ends the packet of the first
        bench.next_cycles(20);
        bench.add(run_of(0x1, 2));
        bench.next_cycles(40);
    });
    EXPECT_EQ(bench.unit.idle()[Slot::Ports], 3U);
    EXPECT_EQ(bench.unit.idle()[Slot::Conflict], 3U + 18 * 4 + 3);
}

// Room for eight packets; each of these tasks needs one of its own.
TEST(PackingPorts, PacketsThatAreNotFullTakeRoom) {
    PackingBench bench(true, pixel_ports(1, 4));
    bench.drive([&] {
        for (std::int16_t row = 0; row < 8; ++row) {
            EXPECT_TRUE(bench.unit.room_by_ports(0, run_of(0x1, row), 0x1, 0)) << row;
            bench.add(run_of(0x1, row));
        }
        EXPECT_FALSE(bench.unit.room_by_ports(0, run_of(0x1, 8), 0x1, 0));
        EXPECT_TRUE(bench.unit.room_by_ports(0, run_of(0x2, 8), 0x2, 0)); // joins the last one
        bench.next_cycle(1);
        EXPECT_TRUE(bench.unit.room_by_ports(1, run_of(0x1, 8), 0x1, 0));
    });
}

} // namespace
} // namespace degs
