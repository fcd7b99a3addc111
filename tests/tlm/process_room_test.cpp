// SPDX-License-Identifier: Apache-2.0
// Processes that ask for room before they write.
#include <memory>
#include <string>
#include <vector>

#include "tests/tlm/process_bench.hpp"
#include "tests/tlm/script.hpp"
#include "tlm/process.hpp"

namespace degs {
namespace {

using test::ProcessBench;
using test::Script;

class RoomIn : public ::testing::TestWithParam<Fidelity> {};

// Read at 6 with release latency 2: no room at 7, room at 8. The writer asks before the reader's
// host time has come that far.
TEST_P(RoomIn, IsExactToTheCycle) {
    ProcessBench bench(GetParam());
    DatedFifo<int> ring("ring", bench.time, 1, 1, 2);
    Process writer(bench.time);
    Process reader(bench.time);
    ring.connect_writer(writer);
    ring.connect_reader(reader);
    const Script write("write", [&] {
        EXPECT_TRUE(ring.has_room(writer));
        ring.put(writer, 1);
        for (writer.advance(); writer.local() < 8; writer.advance()) {
            EXPECT_FALSE(ring.has_room(writer)) << writer.local();
        }
        EXPECT_TRUE(ring.has_room(writer));
        ring.put(writer, 2);
        EXPECT_EQ(writer.local(), 8U);
        writer.finish();
    });
    const Script read("read", [&] {
        reader.advance(6);
        EXPECT_EQ(ring.take(reader), 1);
        reader.advance(20);
        EXPECT_EQ(ring.get(reader), 2);
        reader.finish();
    });
    sc_core::sc_start();
    EXPECT_EQ(writer.local(), kNever);
    EXPECT_EQ(reader.local(), kNever);
}

// More items than a ring has cells at first, then as many as it has places.
TEST_P(RoomIn, IsTakenAtOnce) {
    constexpr int places = 40;
    ProcessBench bench(GetParam());
    DatedFifo<int> ring("ring", bench.time, places, 1, 1);
    Process writer(bench.time);
    Process reader(bench.time);
    ring.connect_writer(writer);
    ring.connect_reader(reader);
    const Script write("write", [&] {
        for (int i = 0; i < places; ++i) {
            ASSERT_TRUE(ring.reserve_now(writer)) << i;
            ring.staged() = i;
            ring.put_staged(writer);
        }
        EXPECT_EQ(writer.local(), 0U);
        for (; writer.local() < 51; writer.advance()) {
            ASSERT_FALSE(ring.reserve_now(writer)) << writer.local();
        }
        ASSERT_TRUE(ring.reserve_now(writer));
        ring.staged() = places;
        ring.put_staged(writer);
        EXPECT_EQ(writer.local(), 51U);
        writer.finish();
    });
    const Script read("read", [&] {
        reader.advance(50);
        for (int i = 0; i <= places; ++i) {
            EXPECT_EQ(ring.get(reader), i);
        }
        EXPECT_EQ(reader.local(), 52U);
        reader.finish();
    });
    sc_core::sc_start();
    EXPECT_EQ(writer.local(), kNever);
    EXPECT_EQ(reader.local(), kNever);
}

// Two writers that ask for room and an arbiter that asks for items, all of each other: whoever has
// the earliest date goes on. Either writer's ring holds one item that is read every third cycle.
TEST_P(RoomIn, WritersAndReadersMayAskEachOther) {
    ProcessBench bench(GetParam());
    DatedFifo<int> rings[] = {{"ring0", bench.time, 1, 1, 1}, {"ring1", bench.time, 1, 1, 1}};
    Process writers[] = {Process(bench.time), Process(bench.time)};
    Process arbiter(bench.time);
    std::vector<Cycle> written[2];
    std::vector<std::unique_ptr<Script>> scripts;
    for (int w = 0; w < 2; ++w) {
        rings[w].connect_writer(writers[w]);
        rings[w].connect_reader(arbiter);
        scripts.push_back(std::make_unique<Script>(("write" + std::to_string(w)).c_str(), [&, w] {
            while (written[w].size() < 20) {
                if (rings[w].has_room(writers[w])) {
                    written[w].push_back(writers[w].local());
                    rings[w].put(writers[w], 0);
                }
                writers[w].advance();
            }
            writers[w].finish();
        }));
    }
    const Script arbitrate("arbitrate", [&] {
        for (int left = 40; left > 0; arbiter.advance()) {
            auto& ring = rings[arbiter.local() % 3 % 2]; // 0, 1, 0; 0, 1, 0; ...
            if (arbiter.local() % 3 != 2 && arbiter.arrived(ring)) {
                ring.drop(arbiter);
                --left;
            }
        }
        arbiter.finish();
    });
    sc_core::sc_start();
    ASSERT_EQ(written[0].size(), 20U);
    ASSERT_EQ(written[1].size(), 20U);
    // Written at 0; read at 3, 6, ... and 1, 4, ...; written again in the cycle after.
    for (Cycle i = 1; i < 20; ++i) {
        EXPECT_EQ(written[0][i], 3 * i + 1);
        EXPECT_EQ(written[1][i], 3 * i - 1);
    }
}

// The reader acts at 6 when kernel time has come half a cycle further. The writer, which asks for
// room at 8, must not take the beginning of that cycle for its end.
TEST_P(RoomIn, CountsAReadOfTheSecondHalfOfACycle) {
    ProcessBench bench(GetParam());
    DatedFifo<int> ring("ring", bench.time, 1, 1, 2);
    Process writer(bench.time);
    Process reader(bench.time);
    ring.connect_writer(writer);
    ring.connect_reader(reader);
    bool room = false;
    const Script write("write", [&] {
        ring.put(writer, 1);
        writer.advance_to(8);
        room = ring.has_room(writer);
        writer.finish();
    });
    const Script read("read", [&] {
        reader.advance(6);
        sc_core::wait(sc_core::sc_time(6.5, sc_core::SC_NS) - sc_core::sc_time_stamp());
        EXPECT_EQ(ring.take(reader), 1);
        reader.finish();
    });
    sc_core::sc_start();
    EXPECT_TRUE(room);
}

INSTANTIATE_TEST_SUITE_P(Fidelities, RoomIn, test::both_fidelities(), test::fidelity_name);

} // namespace
} // namespace degs
