// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/scheduler/segment_queue.hpp"

#include <algorithm>
#include <deque>
#include <random>

#include <gtest/gtest.h>

namespace degs {
namespace {

// Room for one tile at first, then for eight: each keeps its segments, their order and its dates.
TEST(SegmentQueue, HoldsAsManyTilesAsAreInFlight) {
    SegmentQueue queue(64, 1, 3, DomainScan::Oldest);
    for (std::size_t number = 5; number < 13; ++number) {
        queue.hold(5, number);
        SegmentQueue::Tile& tile = queue.tile(number);
        queue.push(tile, 1, 10 * number);
        queue.push(tile, 1, 10 * number + 1);
        queue.push(tile, 2, 10 * number + 2);
        EXPECT_EQ(queue.pick(tile, 50), 1);
        queue.set_ready_at(tile, 1, 60 + number);
    }
    for (std::size_t number = 5; number < 13; ++number) {
        SegmentQueue::Tile& tile = queue.tile(number);
        ASSERT_EQ(tile.waiting(), 3U);
        EXPECT_EQ(tile.front(1).sequence, 10 * number);
        EXPECT_EQ(queue.next_ready(tile), 60 + number);
        EXPECT_EQ(queue.pick(tile, 59 + number), 2); // the other domain is within the distance
        EXPECT_EQ(queue.pick(tile, 60 + number), 1);
        queue.pop(tile, 1);
        EXPECT_EQ(tile.front(1).sequence, 10 * number + 1);
    }
}

TEST(SegmentQueue, KeepsOrderInsideADomain) {
    SegmentQueue queue(4, 1, 3, DomainScan::Oldest);
    for (std::uint64_t i = 0; i < 4; ++i) {
        EXPECT_FALSE(queue.full());
        queue.push(queue.tile(0), 1, i);
    }
    EXPECT_TRUE(queue.full());
    EXPECT_EQ(queue.size(), 4U);
    EXPECT_EQ(queue.tile(0).waiting(), 4U);
    EXPECT_FALSE(queue.tile(0).has_waiting(0));
    for (std::uint64_t i = 0; i < 4; ++i) {
        EXPECT_EQ(queue.tile(0).front(1).sequence, i);
        queue.pop(queue.tile(0), 1);
    }
    EXPECT_TRUE(queue.empty());
    EXPECT_EQ(queue.pick(queue.tile(0), 100), -1);
}

void fill_three_domains(SegmentQueue& queue) {
    queue.push(queue.tile(0), 2, 0);
    queue.push(queue.tile(0), 1, 1);
    queue.push(queue.tile(0), 3, 2);
    queue.push(queue.tile(0), 3, 3);
}

TEST(SegmentQueue, OldestPicksTheFirstHead) {
    SegmentQueue queue(8, 1, 4, DomainScan::Oldest);
    fill_three_domains(queue);
    EXPECT_EQ(queue.pick(queue.tile(0), 0), 2);
    queue.pop(queue.tile(0), 2);
    EXPECT_EQ(queue.pick(queue.tile(0), 0), 1);
}

TEST(SegmentQueue, DeepestPicksTheLongestListThenTheOldest) {
    SegmentQueue queue(8, 1, 4, DomainScan::Deepest);
    fill_three_domains(queue);
    EXPECT_EQ(queue.pick(queue.tile(0), 0), 3);
    queue.pop(queue.tile(0), 3); // equally deep now
    EXPECT_EQ(queue.pick(queue.tile(0), 0), 2);
}

TEST(SegmentQueue, RoundRobinGoesOnBehindTheLastPick) {
    SegmentQueue queue(8, 1, 4, DomainScan::RoundRobin);
    fill_three_domains(queue);
    for (const int expected : {1, 2, 3, 1}) {
        EXPECT_EQ(queue.pick(queue.tile(0), 0), expected);
    }
}

TEST(SegmentQueue, ARoundBeginsAnewWithItsTile) {
    SegmentQueue queue(8, 1, 4, DomainScan::RoundRobin);
    for (int tile = 0; tile < 2; ++tile) {
        queue.push(queue.tile(tile), 0, 0);
        queue.push(queue.tile(tile), 2, 1);
        EXPECT_EQ(queue.pick(queue.tile(tile), 0), 0);
        queue.pop(queue.tile(tile), 0);
        queue.pop(queue.tile(tile), 2);
        queue.clear(queue.tile(tile));
    }
}

TEST(SegmentQueue, BlockedAtTMinusOneLegalAtT) {
    for (const DomainScan scan :
         {DomainScan::RoundRobin, DomainScan::Oldest, DomainScan::Deepest}) {
        SegmentQueue queue(8, 1, 2, scan);
        queue.push(queue.tile(0), 0, 0);
        queue.push(queue.tile(0), 0, 1);
        EXPECT_EQ(queue.pick(queue.tile(0), 10), 0);
        queue.set_ready_at(queue.tile(0), 0, 14);
        queue.pop(queue.tile(0), 0);
        EXPECT_EQ(queue.next_ready(queue.tile(0)), 14U);
        EXPECT_EQ(queue.pick(queue.tile(0), 13), -1);
        EXPECT_EQ(queue.pick(queue.tile(0), 14), 0);
        EXPECT_EQ(queue.next_ready(queue.tile(0)), kNever);
    }
}

TEST(SegmentQueue, LivePixelsAreTheBanksUntilTheTileIsCleared) {
    SegmentQueue queue(4, 2, 2, DomainScan::Oldest);
    EXPECT_EQ(queue.tile(1).live(0), ~0U);
    queue.tile(1).set_live(0, 0x5);
    EXPECT_EQ(queue.tile(3).live(0), 0x5U) << "tiles two apart share a part";
    EXPECT_EQ(queue.tile(0).live(0), ~0U);
    queue.clear(queue.tile(1));
    EXPECT_EQ(queue.tile(1).live(0), ~0U);
}

TEST(SegmentQueue, EndedPixelsAddUpUntilTheSlotIsCleared) {
    SegmentQueue queue(4, 2, 2, DomainScan::Oldest);
    EXPECT_EQ(queue.tile(1).end_pixels(0, 0x3), 0x3U);
    EXPECT_EQ(queue.tile(1).end_pixels(0, 0x6), 0x7U);
    EXPECT_EQ(queue.tile(0).end_pixels(0, 0), 0U);
    EXPECT_EQ(queue.tile(1).end_pixels(1, 0), 0U);
    queue.set_ready_at(queue.tile(1), 0, 50);
    queue.clear(queue.tile(1));
    EXPECT_EQ(queue.tile(1).end_pixels(0, 0), 0U);
    queue.push(queue.tile(1), 0, 0);
    EXPECT_EQ(queue.pick(queue.tile(1), 1), 0); // nor is it within a reuse distance
}

/// The rules of the queue with plain lists and a date per domain.
struct Model {
    struct Domain {
        std::deque<std::uint64_t> waiting;
        Cycle ready = 0;
    };
    std::vector<Domain> domains;
    std::size_t cursor = 0;
    explicit Model(std::size_t count) : domains(count) {}

    int pick(Cycle date, DomainScan scan) {
        int best = -1;
        for (std::size_t step = 0; step < domains.size(); ++step) {
            const std::size_t i =
                scan == DomainScan::RoundRobin ? (cursor + step) % domains.size() : step;
            const Domain& d = domains[i];
            if (d.waiting.empty() || d.ready > date) {
                continue;
            }
            if (scan == DomainScan::RoundRobin) {
                cursor = (i + 1) % domains.size();
                return static_cast<int>(i);
            }
            const auto rank = [scan](const Domain& x) {
                const std::size_t depth = scan == DomainScan::Deepest ? x.waiting.size() : 0;
                return std::make_pair(-static_cast<long>(depth), x.waiting.front());
            };
            if (best < 0 || rank(d) < rank(domains[static_cast<std::size_t>(best)])) {
                best = static_cast<int>(i);
            }
        }
        return best;
    }
    Cycle next_ready(Cycle after) const {
        Cycle next = kNever;
        for (const Domain& d : domains) {
            if (!d.waiting.empty() && d.ready > after) {
                next = std::min(next, d.ready);
            }
        }
        return next;
    }
};

class SegmentQueueOf : public ::testing::TestWithParam<DomainScan> {};

// More domains than a machine word has bits, dates that stand still, creep and jump.
TEST_P(SegmentQueueOf, BehavesAsPlainLists) {
    for (const int count : {1, 5, 64, 65, 200}) {
        std::mt19937 random(static_cast<unsigned>(count));
        SegmentQueue queue(24, 2, count, GetParam());
        Model model(static_cast<std::size_t>(count));
        std::uint64_t sequence = 0;
        Cycle date = 0;
        for (int step = 0; step < 20000; ++step) {
            if (!queue.full() && random() % 2 == 0) {
                const auto domain =
                    static_cast<std::size_t>(random() % static_cast<unsigned>(count));
                queue.push(queue.tile(1), static_cast<int>(domain), sequence);
                model.domains[domain].waiting.push_back(sequence++);
            }
            date += random() % 50 == 0 ? random() % 400 : random() % 3;
            const int domain = queue.pick(queue.tile(1), date);
            ASSERT_EQ(domain, model.pick(date, GetParam())) << step;
            ASSERT_EQ(queue.next_ready(queue.tile(1)), model.next_ready(date)) << step;
            if (domain >= 0 && random() % 4 != 0) {
                Model::Domain& taken = model.domains[static_cast<std::size_t>(domain)];
                ASSERT_EQ(queue.tile(1).front(domain).sequence, taken.waiting.front());
                queue.pop(queue.tile(1), domain);
                taken.waiting.pop_front();
                taken.ready = date + 1 + random() % (SegmentQueue::kWheel - 1);
                queue.set_ready_at(queue.tile(1), domain, taken.ready);
            }
        }
    }
}

std::string scan_name(const ::testing::TestParamInfo<DomainScan>& row) {
    constexpr const char* kNames[] = {"RoundRobin", "Oldest", "Deepest"};
    return kNames[row.index];
}

INSTANTIATE_TEST_SUITE_P(Scans, SegmentQueueOf,
                         ::testing::Values(DomainScan::RoundRobin, DomainScan::Oldest,
                                           DomainScan::Deepest),
                         scan_name);

} // namespace
} // namespace degs
