// SPDX-License-Identifier: Apache-2.0
// Levels of reads: who gets into the read queue first, and what two initiators get of a memory.
#include <algorithm>
#include <numeric>

#include "degs/request_info.hpp"
#include "dram/waiting_reads.hpp"
#include "tests/dram/bench.hpp"

namespace degs {
namespace {

using test::below;
using test::ChannelBench;

/// WaitingReads again, as a list that is searched from end to end.
struct NaiveReads {
    struct Read {
        dram::Access access;
        long long number = 0; // less for a higher level
    };
    int step = 0;
    std::vector<Read> waiting; // in the order of their arrival
    long long pushed = 0;

    void push(const dram::Access& access) {
        waiting.push_back({access, pushed++ - static_cast<long long>(step) * access.qos});
    }
    std::vector<std::size_t> ready(dram::Ck date, bool urgent_room, bool ordinary_room) const {
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < waiting.size(); ++i) {
            const bool room = waiting[i].access.urgent ? urgent_room : ordinary_room;
            if (room && waiting[i].access.date <= date) {
                found.push_back(i);
            }
        }
        return found;
    }
    std::uint32_t take(const std::vector<std::size_t>& ready) {
        std::size_t first = ready.front();
        for (const std::size_t i : ready) {
            const auto key = [&](std::size_t each) {
                return std::pair(waiting[each].number, -int{waiting[each].access.qos});
            };
            first = key(i) < key(first) ? i : first;
        }
        const unsigned level = waiting[first].access.qos;
        std::size_t taken = waiting.size();
        for (const std::size_t i : ready) {
            if (waiting[i].access.qos == level &&
                (taken == waiting.size() ||
                 (waiting[i].access.urgent && !waiting[taken].access.urgent))) {
                taken = i;
            }
        }
        const std::uint32_t id = waiting[taken].access.id;
        waiting.erase(waiting.begin() + static_cast<std::ptrdiff_t>(taken));
        return id;
    }
};

TEST(WaitingReads, TakesWhatASearchFromEndToEndFinds) {
    for (const int step : {0, 1, 5, 64}) {
        std::mt19937 random(static_cast<unsigned>(step));
        dram::WaitingReads reads(step);
        NaiveReads naive;
        naive.step = step;
        dram::Ck date = 0;
        int taken = 0;
        for (std::uint32_t n = 0; n < 20000; ++n) {
            if (below(random, 5) < 2) {
                dram::Access access;
                date += below(random, 3);
                access.date = date;
                access.id = n;
                access.qos = static_cast<std::uint8_t>(below(random, 4));
                access.urgent = below(random, 3) == 0;
                reads.push(access);
                naive.push(access);
            }
            const bool urgent = below(random, 3) != 0;
            const bool ordinary = urgent && below(random, 2) == 0;
            const dram::Ck now = date - std::min<dram::Ck>(date, below(random, 3));
            const auto ready = naive.ready(now, urgent, ordinary);
            ASSERT_EQ(reads.ready(now, {urgent, ordinary}), !ready.empty()) << n;
            ASSERT_EQ(reads.size(), naive.waiting.size());
            if (!ready.empty() && below(random, 2) == 0) {
                ASSERT_EQ(reads.take(now, {urgent, ordinary}).id, naive.take(ready)) << n;
                ++taken;
            }
        }
        EXPECT_GT(taken, 3000);
    }
}

/// The order in which one bank serves reads that come together, `low` of level 0 and then as many
/// of level `qos`, with a row cycle each: a queue that is full of those that count as the earliest.
std::vector<int> order_in_bank(int low, int qos, int step, std::size_t depth) {
    std::vector<int> waiting, queue, served;
    std::vector<int> age(2U * low); // in the queue
    for (int i = 0; i < 2 * low; ++i) {
        waiting.push_back(i);
    }
    const auto level = [&](int read) { return read < low ? 0 : qos; };
    int admitted = 0;
    const auto admit = [&](int end) { // of the reads that have come
        while (queue.size() < depth) {
            int first = -1;
            for (const int read : waiting) {
                const auto number = [&](int each) { return each - step * level(each); };
                if (read < end && (first < 0 || number(read) < number(first) ||
                                   (number(read) == number(first) && level(read) > level(first)))) {
                    first = read;
                }
            }
            if (first < 0) {
                return;
            }
            waiting.erase(std::find(waiting.begin(), waiting.end(), first));
            age[first] = admitted++ - step * level(first);
            queue.push_back(first);
        }
    };
    admit(low); // the others come a CK later
    while (served.size() < age.size()) {
        admit(2 * low);
        const auto next = std::min_element(queue.begin(), queue.end(),
                                           [&](int a, int b) { return age[a] < age[b]; });
        served.push_back(*next);
        queue.erase(next);
    }
    return served;
}

class Lpddr5Qos : public ::testing::TestWithParam<const char*> {};

TEST_P(Lpddr5Qos, ALevelCountsAsAnEarlierArrival) {
    constexpr int kReads = 60, kLevel = 2;
    for (const int step : {0, 10, 40}) {
        for (const int depth : {1, 16, 64}) {
            ChannelBench bench(test::lpddr5_config(
                "lpddr5-6400x256",
                {std::string("controller.scheduler=") + GetParam(), "controller.refresh=none",
                 "controller.qos_step=" + std::to_string(step),
                 "controller.read_queue=" + std::to_string(depth)}));
            for (int i = 0; i < 2 * kReads; ++i) {
                const bool late = i >= kReads;
                bench.push(late ? 11 : 10, 5, i + 1U, false, 1, 0, false, late ? kLevel : 0);
            }
            bench.run_out();
            std::vector<int> served(2U * kReads);
            std::iota(served.begin(), served.end(), 0);
            std::sort(served.begin(), served.end(),
                      [&](int a, int b) { return bench.answers[a] < bench.answers[b]; });
            std::vector<int> expected = order_in_bank(kReads, kLevel, step, depth);
            if (GetParam() == std::string("frfcfs")) { // does not close the row that it has opened
                expected.erase(std::find(expected.begin(), expected.end(), 0));
                expected.insert(expected.begin(), 0);
            }
            EXPECT_EQ(served, expected) << step << ' ' << depth;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Policies, Lpddr5Qos, ::testing::Values("fcfs", "bank_fcfs", "frfcfs"));

/// A memory of its own, of which two initiators ask for more than it has: 128 reads of 256 B each
/// in flight.
class Contest : public sc_core::sc_module {
public:
    Contest(const sc_core::sc_module_name& name, std::vector<unsigned> qos)
        : sc_core::sc_module(name), bench_(test::lpddr5_config("lpddr5-6400x256"), 0, qos.size()) {
        for (std::size_t i = 0; i < qos.size(); ++i) {
            scripts_.push_back(
                std::make_unique<test::Script>(("script_" + std::to_string(i)).c_str(),
                                               [this, i, level = qos[i]] { read(i, level); }));
        }
    }
    /// The part of all reads that the first has.
    double share() const {
        const auto reads = [this](std::size_t i) {
            return static_cast<double>(bench_.memory.stats(i).reads);
        };
        return reads(0) / (reads(0) + reads(1));
    }

private:
    void read(std::size_t initiator, unsigned level) {
        std::mt19937 random(static_cast<unsigned>(initiator) + 1);
        RequestInfo info;
        info.qos = level;
        std::vector<unsigned char> data(256);
        std::vector<sc_core::sc_time> done(128);
        for (std::size_t n = 0;; ++n) {
            sc_core::sc_time& oldest = done[n % done.size()];
            if (oldest > sc_core::sc_time_stamp()) {
                sc_core::wait(oldest - sc_core::sc_time_stamp());
            }
            tlm::tlm_generic_payload payload;
            test::Initiator::fill(payload, tlm::TLM_READ_COMMAND,
                                  std::uint64_t{below(random, 1U << 20U)} * 256, data.data(), 256);
            payload.set_extension(&info);
            sc_core::sc_time delay;
            bench_.lt[initiator]->out->b_transport(payload, delay);
            payload.clear_extension(&info);
            oldest = sc_core::sc_time_stamp() + delay;
        }
    }

    test::Lpddr5Bench bench_;
    std::vector<std::unique_ptr<test::Script>> scripts_;
};

/// Two AT initiators with as many random reads, which they send as fast as they are taken.
class AtContest : public sc_core::sc_module {
public:
    AtContest(const sc_core::sc_module_name& name, std::vector<unsigned> qos)
        : sc_core::sc_module(name),
          bench_(test::lpddr5_config("lpddr5-6400x256", {"waiting_requests=256"}), qos.size(), 0) {
        for (std::size_t i = 0; i < qos.size(); ++i) {
            std::mt19937 random(static_cast<unsigned>(i) + 1);
            bench_.at[i]->qos = qos[i];
            bench_.at[i]->requests.resize(4000);
            for (test::AtInitiator::Request& request : bench_.at[i]->requests) {
                request.bytes = 256;
                request.address = std::uint64_t{below(random, 1U << 20U)} * 256;
            }
        }
    }
    /// ns at which the last read of an initiator was answered.
    double end_ns(std::size_t initiator) const {
        std::uint64_t last = 0;
        for (const test::AtInitiator::Request& request : bench_.at[initiator]->requests) {
            EXPECT_EQ(request.answers, 1);
            last = std::max(last, request.answered_ps);
        }
        return static_cast<double>(last) / 1000;
    }

private:
    test::Lpddr5Bench bench_;
};

// The memory is the same for all of them, so the later end is, too; the sooner one is half of it at
// best.
TEST(Lpddr5Qos, AHigherLevelEndsSoonerInFourPhases) {
    const AtContest equal("equal", {3, 3}), next("next", {4, 3}), far("far", {15, 0});
    sc_core::sc_start();
    EXPECT_NEAR(equal.end_ns(0), equal.end_ns(1), 0.02 * equal.end_ns(1));
    EXPECT_LT(next.end_ns(0), 0.9 * next.end_ns(1));
    EXPECT_LT(far.end_ns(0), 0.7 * far.end_ns(1));
    EXPECT_GT(far.end_ns(0), 0.48 * far.end_ns(1));
    EXPECT_NEAR(far.end_ns(1), equal.end_ns(1), 0.05 * equal.end_ns(1));
}

// Equal levels get equal shares, a higher one gets more, the more the higher it is, and none
// starves.
TEST(Lpddr5Qos, SharesFollowTheLevels) {
    const Contest equal("equal", {3, 3}), next("next", {4, 3}), far("far", {15, 0}),
        swapped("swapped", {0, 15}), beyond("beyond", {4000, 0});
    sc_core::sc_start(sc_core::sc_time(30, sc_core::SC_US));
    EXPECT_NEAR(equal.share(), 0.5, 0.01);
    EXPECT_GT(next.share(), 0.55);
    EXPECT_GT(far.share(), next.share());
    EXPECT_LT(far.share(), 0.99);
    EXPECT_NEAR(swapped.share(), 1 - far.share(), 0.01);
    EXPECT_EQ(beyond.share(), far.share()); // the highest level is 15
}

} // namespace
} // namespace degs
