// SPDX-License-Identifier: Apache-2.0
#include "tlm/timeline.hpp"

#include <memory>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "tests/tlm/script.hpp"
#include "tlm/dated_fifo.hpp"

namespace degs {
namespace {

using test::Script;
using Sums = std::vector<std::uint64_t>;

TEST(TimeSeries, AddsUpByStep) {
    Timeline timeline({10, 100});
    TimeSeries& series = timeline.series("group", "name");
    series.add(0, 1);
    series.add(9, 2);
    series.add(10, 4);
    series.add(35, 8);
    series.add(5, 16); // back again
    EXPECT_EQ(series.sums(), (Sums{19, 4, 0, 8}));
    EXPECT_EQ(&timeline.series("group", "name"), &series);
    EXPECT_NE(&timeline.series("group", "other"), &series);
}

TEST(TimeSeries, SpreadsAnAmountOverTime) {
    Timeline timeline({10, 100});
    TimeSeries& series = timeline.series("", "");
    series.add(8, 23, 15); // one per cycle
    EXPECT_EQ(series.sums(), (Sums{2, 10, 3}));
    series.add(0, 30, 1); // too little for all, and nothing is lost
    EXPECT_EQ(series.sums(), (Sums{2, 10, 4}));
    series.add(12, 12, 5); // no time at all
    EXPECT_EQ(series.sums(), (Sums{2, 15, 4}));
    series.add(10, 20, 7); // one step
    EXPECT_EQ(series.sums(), (Sums{2, 22, 4}));
}

TEST(TimeSeries, DoublesTheStepWhereTooManyWouldBeNeeded) {
    Timeline timeline({10, 4});
    TimeSeries& series = timeline.series("", "");
    for (Cycle date = 0; date < 40; ++date) {
        series.add(date, 1);
    }
    EXPECT_EQ(series.sums(), (Sums{10, 10, 10, 10}));
    series.add(40, 1);
    EXPECT_EQ(timeline.step(), 20U);
    EXPECT_EQ(series.sums(), (Sums{20, 20, 1}));
    series.add(30, 159, 129);
    EXPECT_EQ(timeline.step(), 40U);
    EXPECT_EQ(series.sums(), (Sums{50, 41, 40, 39}));
}

const TimelineState& state_of(const TimelineTrack& track, const std::string& name) {
    for (const TimelineState& state : track.states) {
        if (state.name == name) {
            return state;
        }
    }
    ADD_FAILURE() << track.name << " has no state " << name;
    static const TimelineState none;
    return none;
}

/// Random work before each item, on both sides of a ring, and what a list of dates says of it.
class RingTimeline : public ::testing::TestWithParam<int> {
protected:
    static constexpr int kItems = 300;
    struct Expected {
        std::vector<Cycle> written, read, write_ready, read_ready;
    };
    std::mt19937 random_{static_cast<unsigned>(GetParam())};
    Cycle upto(Cycle n) { return random_() % (n + 1); }

    static Sums by_step(Cycle step, std::size_t steps, const std::vector<Cycle>& from,
                        const std::vector<Cycle>& to) {
        Sums sums(steps, 0);
        for (std::size_t i = 0; i < from.size(); ++i) {
            for (Cycle date = from[i]; date < to[i]; ++date) {
                sums.at(std::min(date / step, steps - 1))++;
            }
        }
        return sums;
    }
};

TEST_P(RingTimeline, ShowsFillAndWaitingByTheirDates) {
    const Cycle step = 1 + upto(40);
    const std::size_t most_steps = GetParam() % 3 == 0 ? 10 : 100000;
    Timeline timeline({step, most_steps});
    const Fidelity fidelity = GetParam() % 2 == 0 ? Fidelity::Exact : Fidelity::Strict;
    const Timebase time{ClockDomain(1.0), fidelity, &timeline};
    const std::size_t depth = 1 + upto(GetParam() % 4 == 0 ? 100 : 5);
    DatedFifo<int> ring("ring", time, depth, upto(3), upto(2));
    Process writer(time), reader(time);
    Cycle writer_busy = 0;
    Expected expected;
    std::vector<Cycle> writing, reading, extra, busy_from, busy_to;
    for (int i = 0; i < kItems; ++i) {
        const bool burst = i / 40 % 2 == 0;
        writing.push_back(upto(burst ? 2 : 30));
        reading.push_back(upto(burst ? 12 : 3));
        extra.push_back(upto(9) == 0 ? upto(200) : 0);
    }
    std::unique_ptr<Script> source, sink;
    source = std::make_unique<Script>("source", [&] {
        for (int i = 0; i < kItems; ++i) {
            busy_from.push_back(writer.local());
            writer.work(writing[i], writer_busy);
            busy_to.push_back(writer.local());
            expected.write_ready.push_back(writer.local());
            ring.reserve(writer);
            expected.written.push_back(writer.local());
            ring.put_at(writer, i, writer.local() + extra[i]);
        }
        writer.finish();
    });
    sink = std::make_unique<Script>("sink", [&] {
        for (int i = 0; i < kItems; ++i) {
            reader.advance(reading[i]);
            expected.read_ready.push_back(reader.local());
            EXPECT_EQ(ring.get(reader), i);
            expected.read.push_back(reader.local());
        }
        reader.finish();
    });
    writer.show(*source, writer_busy);
    reader.show(*sink);
    sc_core::sc_start();
    const Cycle end = expected.read.back() + 1;
    const TimelineRecord record = timeline.record(end);
    if (most_steps == 10) {
        EXPECT_LE(record.steps(), 10U);
    } else {
        EXPECT_EQ(record.step, step);
    }
    const auto sums = [&](const std::vector<Cycle>& from, const std::vector<Cycle>& to) {
        return by_step(record.step, record.steps(), from, to);
    };
    ASSERT_EQ(record.rings.size(), 1U);
    EXPECT_EQ(record.rings[0].depth, depth);
    EXPECT_EQ(record.rings[0].cell_cycles, sums(expected.written, expected.read));
    ASSERT_EQ(record.tracks.size(), 2U);
    EXPECT_EQ(record.tracks[0].name, "source");
    EXPECT_EQ(state_of(record.tracks[0], "busy").cycles, sums(busy_from, busy_to));
    if (ring.stats().full_cycles != 0) {
        EXPECT_EQ(state_of(record.tracks[0], "blocked by sink").cycles,
                  sums(expected.write_ready, expected.written));
    }
    EXPECT_EQ(state_of(record.tracks[1], "waits for source").cycles,
              sums(expected.read_ready, expected.read));
}

INSTANTIATE_TEST_SUITE_P(Random, RingTimeline, ::testing::Range(0, 24));

} // namespace
} // namespace degs
