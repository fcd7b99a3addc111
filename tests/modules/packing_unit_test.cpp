// SPDX-License-Identifier: Apache-2.0
#include "modules/scheduler/packing_unit.hpp"

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

    explicit PackingBench(bool reorganisation = true)
        : unit("unit", {4, static_cast<int>(kLatency), 8, reorganisation}) {
        unit.out.bind(ring);
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
        unit.send_due(bank, Idle::Conflict);
        unit.close_cycles(bank, until, Idle::Conflict);
        bank.advance_to(until);
    }
    /// The same for every cycle until then.
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
        EXPECT_EQ(bench.unit.open_until(), kNever);
        EXPECT_EQ(bench.add(run_of(0xFFF)), kLatency + 2); // slots 2, 3, 4
        EXPECT_EQ(bench.unit.next_execution(0), 5U);
        bench.add(run_of(0x1)); // opens slot 5
        EXPECT_EQ(bench.unit.open_until(), 3U);
        EXPECT_FALSE(bench.unit.due(2));
        EXPECT_TRUE(bench.unit.due(3));
        bench.next_cycle(2);
        EXPECT_EQ(bench.add(run_of(0x2)), 5U); // joins
        bench.next_cycle(3);
        bench.next_cycle(9);
        EXPECT_EQ(bench.unit.open_until(), kNever);
        EXPECT_EQ(bench.unit.next_execution(9), 9 + kLatency);
        bench.add(run_of(0xF));
        bench.next_cycle(10);
    });
    ASSERT_EQ(bench.got.size(), 5U);
    EXPECT_EQ(bench.got[3].date, 5U);
    EXPECT_EQ(bench.got[3].packet.tasks, 2);
    EXPECT_EQ(bench.got[3].packet.run_count, 2);
    EXPECT_EQ(bench.got[4].date, 11U);
    // Two empty places in slot 5, nothing in slots 6 to 10.
    EXPECT_EQ(bench.unit.idle().conflict, 2U + 5 * 4);
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
    EXPECT_EQ(bench.unit.idle().blocked, 3U + 3 + 2 + 3 + 0 + 2);
    EXPECT_EQ(bench.unit.idle().conflict, 3U);
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

} // namespace
} // namespace degs
