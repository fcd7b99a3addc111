// SPDX-License-Identifier: Apache-2.0
// Items whose memory answers after they have been put into a ring.
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "tests/tlm/process_bench.hpp"
#include "tests/tlm/script.hpp"
#include "tlm/completion.hpp"

namespace degs {
namespace {

using test::ProcessBench;
using test::Script;

TEST(Completion, TheLatestOfTwoIsKnownWithTheSecond) {
    const auto a = std::make_shared<LateAnswer>();
    const auto b = std::make_shared<LateAnswer>();
    const Completion both = latest(latest(Completion(a), Completion(5)), Completion(b));
    Cycle told = 0;
    both.when_known([&told](Cycle date) { told = date; });
    a->come(9);
    EXPECT_FALSE(both.known());
    EXPECT_THROW(both.date(), std::logic_error);
    EXPECT_EQ(told, 0U);
    b->come(7);
    ASSERT_TRUE(both.known());
    EXPECT_EQ(both.date(), 9U);
    EXPECT_EQ(told, 9U);
    EXPECT_EQ(latest(both, Completion(12)).date(), 12U);
    EXPECT_EQ(latest(Completion(3), Completion(4)).date(), 4U);
    EXPECT_EQ(latest(Completion(a), Completion(a)).date(), 9U);
}

class LateItems : public ::testing::TestWithParam<Fidelity> {
protected:
    ProcessBench bench{GetParam()};

    /// An answer that comes at `date`, as that of an AT memory: the kernel must get there.
    Completion answer_at(Cycle date) {
        const auto late = std::make_shared<LateAnswer>();
        due_.emplace(date, late);
        asked_.notify(sc_core::SC_ZERO_TIME);
        return Completion(late);
    }

private:
    void serve() {
        for (;;) {
            const sc_core::sc_time now = sc_core::sc_time_stamp();
            if (due_.empty()) {
                sc_core::wait(asked_);
            } else if (const auto next = due_.begin(); bench.time.clock.at(next->first) > now) {
                sc_core::wait(bench.time.clock.at(next->first) - now, asked_);
            } else {
                const auto [date, answer] = *next;
                due_.erase(next);
                answer->come(date);
            }
        }
    }
    std::multimap<Cycle, std::shared_ptr<LateAnswer>> due_;
    sc_core::sc_event asked_;
    Script memory_{"memory", [this] { serve(); }};
};

TEST_P(LateItems, AreReadInOrderFromTheDateOfTheirAnswers) {
    DatedFifo<int> ring("ring", bench.time, 64);
    Process writer(bench.time);
    Process reader(bench.time);
    ring.connect_writer(writer);
    std::vector<std::pair<int, Cycle>> read;
    const Script write("write", [&] {
        for (int i = 0; i < 40; ++i) { // more than the first cells of a ring
            ring.put_at(writer, i, i == 1 ? Completion(3) : answer_at(i == 2 ? 15 : 20 + i));
            writer.advance();
        }
        writer.finish();
    });
    const Script take("take", [&] {
        for (int i = 0; i < 40; ++i) {
            const int item = ring.get(reader);
            read.emplace_back(item, reader.local());
        }
    });
    sc_core::sc_start();
    ASSERT_EQ(read.size(), 40U);
    for (int i = 0; i < 40; ++i) {
        EXPECT_EQ(read[i].first, i);
        const Cycle expected = i < 3 ? 20 : 20 + i; // 1 and 2 are answered before 0
        EXPECT_EQ(read[i].second, expected) << i;
    }
    EXPECT_EQ(ring.stats().items, 40U);
}

TEST_P(LateItems, TakeTheCellsOfTheRing) {
    DatedFifo<int> ring("ring", bench.time, 2);
    Process writer(bench.time);
    Process reader(bench.time);
    ring.connect_reader(reader);
    std::vector<Cycle> written;
    const Script write("write", [&] {
        for (int i = 0; i < 4; ++i) {
            ring.reserve(writer);
            ring.put_at(writer, i, answer_at(writer.local() + 10));
            written.push_back(writer.local());
            writer.advance();
        }
    });
    const Script take("take", [&] {
        for (int i = 0; i < 4; ++i) {
            EXPECT_EQ(ring.get(reader), i);
        }
    });
    sc_core::sc_start();
    EXPECT_EQ(written, (std::vector<Cycle>{0, 1, 10, 11}));
    EXPECT_EQ(reader.local(), 21U);
}

// A reader must not conclude from a ring without readable items, whose writer is far ahead, that
// nothing comes.
TEST_P(LateItems, CountInQuestionsOfOrder) {
    DatedFifo<int> late("late", bench.time, 4);
    DatedFifo<int> early("early", bench.time, 4);
    Process late_writer(bench.time);
    Process early_writer(bench.time);
    Process reader(bench.time);
    late.connect_writer(late_writer);
    early.connect_writer(early_writer);
    late.connect_reader(reader);
    early.connect_reader(reader);
    const Script first("first", [&] {
        late.put_at(late_writer, 1, answer_at(20));
        late_writer.advance(1000);
        late_writer.finish();
    });
    const Script second("second", [&] {
        early_writer.advance(29);
        early.put(early_writer, 2);
        early_writer.finish();
    });
    const Script ask("ask", [&] {
        FifoBase* const inputs[] = {&late, &early};
        EXPECT_EQ(reader.next_arrival(inputs, 2, 0, 12), 12U);
        reader.advance_to(12);
        EXPECT_FALSE(reader.arrived(late));
        EXPECT_EQ(reader.next_arrival(inputs, 2, 12, kNever), 20U);
        reader.advance_to(20);
        EXPECT_TRUE(reader.arrived(late));
        EXPECT_EQ(late.take(reader), 1);
        EXPECT_EQ(reader.next_arrival(inputs, 2, 20, kNever), 30U);
        reader.advance_to(30);
        EXPECT_EQ(early.take(reader), 2);
    });
    sc_core::sc_start();
    EXPECT_EQ(reader.local(), 30U);
}

TEST_P(LateItems, AProcessWaitsForAnAnswer) {
    Process process(bench.time);
    Cycle waited = 0;
    const Script script("script", [&] {
        process.advance(5);
        process.wait_for_memory(latest(answer_at(30), answer_at(25)), waited);
    });
    sc_core::sc_start();
    EXPECT_EQ(process.local(), 30U);
    EXPECT_EQ(waited, 25U);
}

INSTANTIATE_TEST_SUITE_P(In, LateItems, test::both_fidelities(), test::fidelity_name);

} // namespace
} // namespace degs
