// SPDX-License-Identifier: Apache-2.0
// Policies with state and with an order of their own: FR-FCFS with a cap, and one that only this
// test has.
#include "dram/policy_of.hpp"

#include <algorithm>
#include <random>

#include "config/config_document.hpp"
#include "tests/dram/fixture.hpp"

namespace degs {
namespace {

using test::below;
using test::ChannelBench;
using test::Command;

dram::Config with_policy(const std::string& name, std::vector<std::string> overrides = {}) {
    overrides.push_back("controller.scheduler=" + name);
    return test::lpddr5_without_refresh(overrides);
}

dram::Config with_cap(int row_hits, std::vector<std::string> overrides = {}) {
    overrides.push_back("controller.frfcfs_cap.row_hits=" + std::to_string(row_hits));
    return with_policy("frfcfs_cap", overrides);
}

void expect_equal(const std::vector<dram::Issued>& first, const std::vector<dram::Issued>& second) {
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        ASSERT_EQ(first[i].command, second[i].command) << i;
        ASSERT_EQ(first[i].date, second[i].date) << i;
        ASSERT_EQ(first[i].bank, second[i].bank) << i;
        ASSERT_EQ(first[i].row, second[i].row) << i;
    }
}

/// Reads and writes of a few rows, at random dates.
void feed_few_banks(ChannelBench& bench, unsigned seed, int count = 3000,
                    unsigned writes_of_eight = 2) {
    std::mt19937 random(seed);
    dram::Ck date = 0;
    for (int i = 0; i < count; ++i) {
        date += random() % 16 == 0 ? random() % 200 : random() % 4;
        const unsigned bursts = 1 + below(random, 3);
        const unsigned bank = below(random, 4);
        const unsigned row = below(random, 3);
        const bool write = below(random, 8) < writes_of_eight;
        bench.push(date, bank, row, write, bursts, below(random, 16));
    }
}

TEST(Lpddr5Cap, ThatIsNeverReachedIsFrfcfs) {
    ChannelBench capped(with_cap(1 << 20));
    ChannelBench plain(with_policy("frfcfs"));
    for (ChannelBench* bench : {&capped, &plain}) {
        feed_few_banks(*bench, 3);
        bench->run_out();
    }
    EXPECT_EQ(capped.answers, plain.answers);
    expect_equal(capped.trace, plain.trace);
}

// One access waits for row 2 of a bank while many want row 1, which is open.
TEST(Lpddr5Cap, IsTheNumberOfHitsThatTheOldestConflictWaitsFor) {
    for (const int cap : {1, 2, 4, 7, 13}) {
        ChannelBench bench(with_cap(cap));
        bench.push(0, 0, 1); // opens the row
        bench.push(0, 0, 2);
        for (unsigned i = 0; i < 25; ++i) {
            bench.push(0, 0, 1, false, 3, i); // two bursts each are one access
        }
        bench.run_out();
        std::size_t before = 0;
        for (std::uint32_t hit = 2; hit < bench.pushed(); ++hit) {
            before += bench.answers[hit] < bench.answers[1] ? 1 : 0;
        }
        EXPECT_EQ(before, static_cast<std::size_t>(cap));
    }
}

/// Reads that came later and were answered earlier while an access was the oldest of its bank: the
/// most of any access.
std::size_t most_overtakers(const ChannelBench& bench, const std::vector<unsigned>& banks) {
    std::size_t most = 0;
    for (std::uint32_t id = 0; id < banks.size(); ++id) {
        dram::Ck oldest_since = 0;
        for (std::uint32_t older = 0; older < id; ++older) {
            if (banks[older] == banks[id]) {
                oldest_since = std::max(oldest_since, bench.answers.at(older));
            }
        }
        std::size_t overtakers = 0;
        for (std::uint32_t later = id + 1; later < banks.size(); ++later) {
            const dram::Ck date = bench.answers.at(later);
            overtakers +=
                banks[later] == banks[id] && date > oldest_since && date < bench.answers.at(id) ? 1
                                                                                                : 0;
        }
        most = std::max(most, overtakers);
    }
    return most;
}

TEST(Lpddr5Cap, BoundsStarvationUnderRandomTraffic) {
    const auto overtakers_of = [](const dram::Config& config) {
        ChannelBench bench(config);
        std::mt19937 random(5);
        std::vector<unsigned> banks;
        for (int i = 0; i < 600; ++i) {
            banks.push_back(below(random, 2));
            bench.push(static_cast<dram::Ck>(i), banks.back(), below(random, 8) / 7, false, 1,
                       below(random, 16));
        }
        bench.run_out();
        return most_overtakers(bench, banks);
    };
    EXPECT_LE(overtakers_of(with_cap(1)), 1U);
    EXPECT_LE(overtakers_of(with_cap(3)), 3U);
    EXPECT_GT(overtakers_of(with_policy("frfcfs")), 6U) << "the traffic starves somebody";
}

// Two rows of a bank in turn: an activation serves the access that wanted it and as many hits as
// the cap allows.
TEST(Lpddr5Cap, GivesTheHitRate) {
    for (const int cap : {1, 3, 7}) {
        ChannelBench bench(with_cap(cap));
        const unsigned count = 1600;
        for (unsigned i = 0; i < count; ++i) {
            bench.push(0, 3, i % 2 + 1, false, 1, i % 32);
        }
        bench.run_out();
        EXPECT_NEAR(dram::hit_rate(bench.channel.stats().accesses), cap / (1.0 + cap), 0.01);
    }
}

TEST(Lpddr5Cap, CostsHitsTheLowerItIs) {
    const auto hits_of = [](const dram::Config& config) {
        ChannelBench bench(config);
        feed_few_banks(bench, 9);
        bench.run_out();
        return bench.channel.stats().accesses[0];
    };
    const std::uint64_t in_order = hits_of(with_policy("bank_fcfs"));
    const std::uint64_t one = hits_of(with_cap(1));
    const std::uint64_t four = hits_of(with_cap(4));
    EXPECT_LT(in_order, one);
    EXPECT_LT(one, four);
    EXPECT_LT(four, hits_of(with_policy("frfcfs")));
}

// What a policy knows goes into the copy, and the copy's run leaves the original as it is.
TEST(Lpddr5Cap, IsCopiedWithItsChannel) {
    ChannelBench bench(with_cap(2));
    feed_few_banks(bench, 8, 60);
    bench.run(90);
    dram::Channel copy = bench.channel;
    copy.observe({});
    dram::Outcome outcome;
    while (!copy.idle()) {
        copy.run(copy.next_date(), outcome);
    }
    EXPECT_FALSE(outcome.answers.empty());
    bench.run_out();
    for (const dram::Answer& answer : outcome.answers) {
        EXPECT_EQ(bench.answers[answer.id], answer.date);
    }
}

TEST(Lpddr5Cap, HasAKeyThatOnlyItUses) {
    const std::string key = "controller.frfcfs_cap.row_hits";
    const std::string file = std::string(DEGS_CONFIGS) + "/memory/lpddr5-6400x256.yaml";
    dram::Config memory;
    const auto warnings = ConfigSource::from_file(file, {key + "=8"}).load(memory);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find(key), std::string::npos) << warnings[0];
    EXPECT_EQ(resolved(memory)["controller"].count("frfcfs_cap"), 0U);
    EXPECT_EQ(resolved(with_cap(8))["controller"]["frfcfs_cap"]["row_hits"], 8);
    const std::vector<KeyDoc> keys = document(dram::Config());
    EXPECT_TRUE(
        std::any_of(keys.begin(), keys.end(), [&](const KeyDoc& row) { return row.path == key; }));
}

/// A policy from outside of the library: the bank that has been served least goes first.
class FewestServed final : public dram::PolicyOf<FewestServed> {
public:
    const char* name() const override { return "fewest_served"; }
    const char* doc() const override { return "the bank that has been served least first"; }
    std::uint8_t hit(const dram::Queue& queue, unsigned bank, std::uint32_t row) const override {
        return queue.oldest_of_row(bank, row);
    }
    bool has_order() const override { return true; }
    std::uint64_t order(const Ready& ready) const override { return served_[ready.bank]; }
    void served(const dram::Queue::Entry& entry) override { ++served_[entry.access.bank]; }

private:
    std::array<std::uint64_t, dram::kMostBanks> served_{};
};

/// A memory that knows it, too, as if a file chose it.
dram::Config with_outsider(const char* file, std::vector<std::string> overrides = {}) {
    overrides.emplace_back("controller.scheduler=fewest_served");
    dram::Config memory;
    memory.controller.policies.emplace_back(FewestServed{});
    ConfigSource::from_file(std::string(DEGS_CONFIGS) + "/memory/" + file + ".yaml", overrides)
        .load(memory);
    return memory;
}

/// The banks of all column commands if bank 0 has twenty hits waiting and bank 4 twenty later ones.
/// This memory has no groups, so any bank may go at any time.
std::string banks_in_order(const dram::Config& config) {
    ChannelBench bench(config);
    bench.push(0, 0, 1);
    bench.push(0, 4, 1);
    bench.run_out();
    bench.trace.clear();
    for (const unsigned bank : {0U, 4U}) {
        for (unsigned i = 0; i < 10; ++i) {
            bench.push(1000, bank, 1, false, 1, i);
        }
    }
    bench.run_out();
    std::string banks;
    for (const dram::Issued& issued : bench.trace) {
        banks += static_cast<char>('0' + issued.bank);
    }
    return banks;
}

TEST(Lpddr5Policy, MayOrderTheBanks) {
    const std::string no_refresh = "controller.refresh=none";
    EXPECT_EQ(banks_in_order(with_outsider("lpddr5-3200x128", {no_refresh})),
              "04040404040404040404");
    EXPECT_EQ(banks_in_order(test::lpddr5_config("lpddr5-3200x128", {no_refresh})),
              "00000000004444444444");
}

TEST(Lpddr5Policy, WithAnOrderOfItsOwnKeepsEveryRule) {
    for (const char* refresh : {"none", "all_bank", "per_bank"}) {
        for (const char* page : {"open", "closed"}) {
            ChannelBench bench(
                with_outsider("lpddr5-6400x256", {std::string("controller.refresh=") + refresh,
                                                  std::string("controller.page_policy=") + page}));
            feed_few_banks(bench, 21);
            bench.run_out();
            EXPECT_EQ(bench.answers.size(), bench.pushed());
            test::check_trace(bench.trace, test::Lpddr5Reference::of("lpddr5-6400x256"));
            test::check_rows(bench.trace);
        }
    }
}

} // namespace
} // namespace degs
