// SPDX-License-Identifier: Apache-2.0
#include "tlm/process.hpp"

#include <gtest/gtest.h>

#include "tests/tlm/arbitration_reference.hpp"
#include "tests/tlm/process_bench.hpp"

namespace degs {
namespace {

using test::CycleByCycle;
using test::DatedSystem;
using test::Logs;
using test::ProcessBench;
using test::Script;
using test::SystemSpec;

constexpr int kSystems = 60; ///< side by side in one elaboration, each in both fidelities

std::string text(const test::Event& e) {
    return "item " + std::to_string(e.index) + " of writer " + std::to_string(e.writer) + " at " +
           std::to_string(e.date) + " (" + std::to_string(e.note) + ")";
}

void expect_equal(const Logs& logs, const Logs& expected, const char* fidelity) {
    for (std::size_t p = 0; p < expected.size(); ++p) {
        if (logs[p] == expected[p]) {
            continue;
        }
        const std::size_t common = std::min(logs[p].size(), expected[p].size());
        std::size_t i = 0;
        while (i < common && logs[p][i] == expected[p][i]) {
            ++i;
        }
        ADD_FAILURE() << fidelity << ", process " << p << ", event " << i << " of "
                      << logs[p].size() << " and " << expected[p].size() << ": "
                      << (i < logs[p].size() ? text(logs[p][i]) : "none") << " instead of "
                      << (i < expected[p].size() ? text(expected[p][i]) : "none");
    }
}

class SmallRunArbitration : public ::testing::TestWithParam<unsigned> {};

// Grants, polls, ticks and every date around them. Systems without proof differ in many seeds.
TEST_P(SmallRunArbitration, EqualsCycleByCycleInBothFidelities) {
    std::mt19937 random(GetParam());
    std::vector<SystemSpec> specs;
    std::vector<std::unique_ptr<DatedSystem>> exact;
    std::vector<std::unique_ptr<DatedSystem>> strict;
    for (int i = 0; i < kSystems; ++i) {
        specs.push_back(test::random_system(random));
        const std::string index = std::to_string(i);
        exact.push_back(
            std::make_unique<DatedSystem>("exact_" + index, specs.back(), Fidelity::Exact));
        strict.push_back(
            std::make_unique<DatedSystem>("strict_" + index, specs.back(), Fidelity::Strict));
    }
    sc_core::sc_start();
    for (std::size_t i = 0; i < specs.size(); ++i) {
        SCOPED_TRACE(i);
        const Logs expected = CycleByCycle(specs[i]).run();
        expect_equal(strict[i]->logs(), expected, "strict");
        expect_equal(exact[i]->logs(), expected, "exact");
    }
}

INSTANTIATE_TEST_SUITE_P(Random, SmallRunArbitration, ::testing::Range(1U, 9U));

// The writer waits for a cell of `busy`; the cell is free again at 5, but the writer has not run
// yet when the arbiter asks. The writer's next date is 5 and not that of `busy`'s reader, who has
// gone on to 105 meanwhile.
TEST(Process, AWriterWhoseCellIsFreeAlreadyCountsFromThatDate) {
    ProcessBench bench;
    const auto busy = bench.ring("busy", 1);
    const auto slow = bench.ring("slow", 4);
    const auto fast = bench.ring("fast", 4);
    Process writer(bench.time), reader(bench.time), other(bench.time), arbiter(bench.time);
    slow->connect_writer(writer);
    fast->connect_writer(other);
    Cycle granted = 0;
    sc_core::sc_event asked;
    const Script write("write", [&] {
        busy->put(writer, 0);
        busy->put(writer, 1); // waits for the reader
        EXPECT_EQ(writer.local(), 5U);
        slow->put(writer, 2); // readable at 6
        writer.finish();
    });
    const Script read("read", [&] {
        sc_core::wait(1, sc_core::SC_NS);
        reader.advance_to(5);
        busy->get(reader);
        reader.advance(100);
        asked.notify(); // now, before the writer wakes
        reader.sync();
        busy->get(reader);
    });
    const Script early("early", [&] {
        other.advance(49);
        fast->put(other, 3); // readable at 50
        other.finish();
    });
    const Script arbitrate("arbitrate", [&] {
        sc_core::wait(asked);
        arbiter.advance_to(1);
        EXPECT_FALSE(busy->full());
        EXPECT_TRUE(writer.blocked());
        EXPECT_EQ(writer.bound(3), 5U);
        FifoBase* inputs[] = {fast.get(), slow.get()};
        granted = arbiter.next_arrival(inputs, 2, arbiter.local(), kNever);
    });
    sc_core::sc_start();
    EXPECT_EQ(granted, 6U);
}

// The writer waits for a full ring whose reader may next act at 10: the cell is free at 10 + 1, and
// the arbiter must not believe that it has longer. Readable at 12, at the date of the other item.
TEST(Process, AWriterWithoutRoomCountsFromItsReadersDate) {
    ProcessBench bench;
    DatedFifo<int> busy("busy", bench.time, 1, 1, 1);
    const auto slow = bench.ring("slow", 4);
    const auto fast = bench.ring("fast", 4);
    Process writer(bench.time), reader(bench.time), other(bench.time), arbiter(bench.time);
    slow->connect_writer(writer);
    fast->connect_writer(other);
    const Script write("write", [&] {
        busy.put(writer, 0);
        busy.put(writer, 1);
        slow->put(writer, 2);
        writer.finish();
    });
    const Script read("read", [&] {
        busy.connect_reader(reader);
        reader.advance(10);
        reader.sync();
        busy.get(reader);
        busy.get(reader);
    });
    const Script early("early", [&] {
        other.advance(11);
        fast->put(other, 3);
        other.finish();
    });
    const Script arbitrate("arbitrate", [&] {
        sc_core::wait(1, sc_core::SC_NS);
        arbiter.advance_to(1);
        EXPECT_EQ(writer.bound(3), 11U);
        FifoBase* inputs[] = {fast.get(), slow.get()};
        EXPECT_EQ(arbiter.next_arrival(inputs, 2, arbiter.local(), kNever), 12U);
        ASSERT_FALSE(slow->empty());
        EXPECT_EQ(slow->head_date(), 12U);
    });
    sc_core::sc_start();
    EXPECT_EQ(writer.local(), kNever);
}

class ProcessIn : public ::testing::TestWithParam<Fidelity> {};

// Four items of one date: ports in order, whatever order the host runs the writers in.
TEST_P(ProcessIn, TiesGoByPortNotByHostOrder) {
    ProcessBench bench(GetParam());
    std::vector<std::unique_ptr<DatedFifo<int>>> rings;
    std::vector<FifoBase*> inputs;
    std::vector<std::unique_ptr<Process>> writers;
    for (int i = 0; i < 4; ++i) {
        rings.push_back(bench.ring(("ring" + std::to_string(i)).c_str(), 2));
        inputs.push_back(rings.back().get());
        writers.push_back(std::make_unique<Process>(bench.time));
        rings.back()->connect_writer(*writers.back());
    }
    std::vector<std::unique_ptr<Script>> scripts;
    for (std::size_t i = 4; i-- > 0;) {
        scripts.push_back(std::make_unique<Script>(("write" + std::to_string(i)).c_str(), [&, i] {
            writers[i]->advance(9);
            rings[i]->put(*writers[i], static_cast<int>(i));
            writers[i]->finish();
        }));
    }
    Process arbiter(bench.time);
    std::vector<int> order;
    const Script arbitrate("arbitrate", [&] {
        while (order.size() < 4) {
            arbiter.advance_to(arbiter.next_arrival(inputs.data(), 4, arbiter.local(), kNever));
            EXPECT_EQ(arbiter.local(), 10U);
            for (auto& ring : rings) {
                EXPECT_FALSE(ring->empty()); // all of cycle 10 is visible at the first grant
                order.push_back(ring->take(arbiter));
            }
        }
        EXPECT_EQ(arbiter.next_arrival(inputs.data(), 4, arbiter.local(), kNever), kNever);
        arbiter.finish();
    });
    sc_core::sc_start();
    EXPECT_EQ(arbiter.local(), kNever);
    EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3}));
}

TEST_P(ProcessIn, NextArrivalStaysBetweenFromAndLimit) {
    ProcessBench bench(GetParam());
    const auto ring = bench.ring("ring", 4, 3);
    Process writer(bench.time);
    Process reader(bench.time);
    ring->connect_writer(writer);
    FifoBase* inputs[] = {ring.get()};
    const Script write("write", [&] {
        writer.advance(10);
        ring->put(writer, 1); // readable at 13
        writer.advance(20);
        ring->put(writer, 2); // readable at 33
        writer.finish();
    });
    const Script read("read", [&] {
        EXPECT_EQ(reader.next_arrival(inputs, 1, 0, 5), 5U);
        EXPECT_EQ(reader.local(), 0U); // asking does not move the date
        EXPECT_EQ(reader.next_arrival(inputs, 1, 0, 13), 13U);
        EXPECT_EQ(reader.next_arrival(inputs, 1, 0, kNever), 13U);
        reader.advance_to(20);
        EXPECT_EQ(reader.next_arrival(inputs, 1, 25, kNever), 25U); // there since 13
        EXPECT_EQ(ring->take(reader), 1);
        EXPECT_EQ(reader.next_arrival(inputs, 1, 25, 32), 32U);
        EXPECT_EQ(reader.next_arrival(inputs, 1, 25, 34), 33U);
        reader.advance_to(33);
        EXPECT_EQ(ring->take(reader), 2);
        EXPECT_EQ(reader.next_arrival(inputs, 1, 40, 50), 50U);
        EXPECT_EQ(reader.next_arrival(inputs, 1, 40, kNever), kNever);
        reader.advance(); // shows that the script came so far
    });
    sc_core::sc_start();
    EXPECT_EQ(reader.local(), 34U);
}

// Written at 7 with forward latency 2: not there at 8, there at 9.
TEST_P(ProcessIn, ArrivedIsExactToTheCycle) {
    ProcessBench bench(GetParam());
    const auto ring = bench.ring("ring", 1, 2);
    Process writer(bench.time);
    Process reader(bench.time);
    ring->connect_writer(writer);
    const Script read("read", [&] { // before the writer, so that it has to ask
        for (; reader.local() < 9; reader.advance()) {
            EXPECT_FALSE(reader.arrived(*ring)) << reader.local();
        }
        EXPECT_TRUE(reader.arrived(*ring));
        ring->take(reader);
        EXPECT_FALSE(reader.arrived(*ring));
    });
    const Script write("write", [&] {
        writer.advance(7);
        ring->put(writer, 0);
        writer.finish();
    });
    sc_core::sc_start();
    EXPECT_EQ(reader.local(), 9U);
}

// A process that everybody asks for its date has one alarm per listener; there is no limit.
TEST_P(ProcessIn, AnyNumberOfReadersMayAskOneWriter) {
    constexpr std::size_t kReaders = 200;
    ProcessBench bench(GetParam());
    Process writer(bench.time);
    std::vector<std::unique_ptr<DatedFifo<int>>> rings;
    std::vector<std::unique_ptr<Process>> readers;
    std::vector<std::unique_ptr<Script>> scripts;
    for (std::size_t i = 0; i < kReaders; ++i) {
        const std::string index = std::to_string(i);
        rings.push_back(bench.ring(("ring" + index).c_str(), 1));
        readers.push_back(std::make_unique<Process>(bench.time));
        rings.back()->connect_writer(writer);
        scripts.push_back(std::make_unique<Script>(("read" + index).c_str(), [&, i] {
            while (!readers[i]->arrived(*rings[i])) {
                readers[i]->advance();
            }
        }));
    }
    const Script write("write", [&] {
        for (std::size_t i = 0; i < kReaders; ++i) {
            writer.advance();
            rings[i]->put(writer, 0);
        }
        writer.finish();
    });
    sc_core::sc_start();
    for (std::size_t i = 0; i < kReaders; ++i) {
        EXPECT_EQ(readers[i]->local(), i + 2);
    }
}

TEST_P(ProcessIn, LocalDatesOnlyRise) {
    ProcessBench bench(GetParam());
    Process self(bench.time);
    const Script script("script", [&] {
        self.advance(3);
        self.advance_to(2);
        EXPECT_EQ(self.local(), 3U);
        if (self.strict()) {
            EXPECT_EQ(sc_core::sc_time_stamp(), bench.time.clock.at(3));
        } else {
            EXPECT_EQ(sc_core::sc_time_stamp(), sc_core::SC_ZERO_TIME);
        }
        self.sync();
        EXPECT_EQ(sc_core::sc_time_stamp(), bench.time.clock.at(3));
        self.finish();
        EXPECT_EQ(self.local(), kNever);
    });
    sc_core::sc_start();
}

INSTANTIATE_TEST_SUITE_P(Fidelities, ProcessIn, test::both_fidelities(), test::fidelity_name);

// The arbiter, which has an item of date 50, hears at 5 that nothing comes before 105. It does not
// have to wait until kernel time has come to 50.
TEST(Process, AProofWakesWhoWaitsForIt) {
    ProcessBench bench;
    const auto slow = bench.ring("slow", 4);
    const auto fast = bench.ring("fast", 4);
    Process writer(bench.time), other(bench.time), arbiter(bench.time);
    slow->connect_writer(writer);
    fast->connect_writer(other);
    const Script early("early", [&] {
        other.advance(49);
        fast->put(other, 1);
        other.finish();
    });
    const Script write("write", [&] {
        writer.advance(5);
        writer.sync();
        writer.advance(100);
        writer.sync();
        slow->put(writer, 2);
        writer.finish();
    });
    const Script arbitrate("arbitrate", [&] {
        sc_core::wait(1, sc_core::SC_NS);
        arbiter.advance_to(1);
        FifoBase* inputs[] = {fast.get(), slow.get()};
        EXPECT_EQ(arbiter.next_arrival(inputs, 2, arbiter.local(), kNever), 50U);
        EXPECT_EQ(sc_core::sc_time_stamp(), sc_core::sc_time(5, sc_core::SC_NS));
    });
    sc_core::sc_start();
}

} // namespace
} // namespace degs
