// SPDX-License-Identifier: Apache-2.0
// A future that goes on instead of being copied again gives the dates that a fresh copy gives.
#include "dram/future.hpp"

#include <map>

#include "tests/dram/fixture.hpp"

namespace degs {
namespace {

using test::below;

/// Dates of answers by id, and how many steps it took to have them.
struct Predicted {
    std::map<std::uint32_t, dram::Ck> dates;
    int steps = 0;
};

/// Collects the dates of `asked`, which `step` runs towards.
template <class Step>
Predicted collect(std::map<std::uint32_t, dram::Ck> asked, const Step& step) {
    Predicted predicted;
    while (!asked.empty()) {
        dram::Outcome outcome;
        step(outcome);
        ++predicted.steps;
        for (const dram::Answer& answer : outcome.answers) {
            if (asked.erase(answer.id) != 0) {
                predicted.dates[answer.id] = answer.date;
            }
        }
    }
    return predicted;
}

/// A channel of which answers are predicted in both ways.
class Pair {
public:
    explicit Pair(const dram::Config& config)
        : rules_(config.timing), channel_(config.timing, rules_, config.controller) {}

    /// Takes accesses with dates behind `known`, and compares the predictions once all up to the
    /// last of them are known. Returns the steps of the future.
    int expect_equal(std::vector<dram::Access> accesses) {
        std::map<std::uint32_t, dram::Ck> asked;
        for (dram::Access& access : accesses) {
            access.id = next_id_++;
            asked[access.id] = access.date;
            future_.push(channel_.marked(access));
            channel_.push(access);
            known_ = access.date;
        }
        // Accesses that the channel itself answers up to here are in no copy of it.
        dram::Outcome outcome;
        channel_.run(known_, outcome);
        std::map<std::uint32_t, dram::Ck> rest = asked;
        Predicted early;
        for (const dram::Answer& answer : outcome.answers) {
            if (rest.erase(answer.id) != 0) {
                early.dates[answer.id] = answer.date;
            }
        }
        dram::Channel copy = channel_;
        Predicted expected =
            collect(rest, [&](dram::Outcome& out) { copy.run(copy.next_date(), out); });
        expected.dates.insert(early.dates.begin(), early.dates.end());
        held_ += future_.holds() ? 1 : 0;
        const bool held = future_.holds();
        future_.follow(channel_, known_);
        Predicted predicted =
            collect(held ? asked : rest, [&](dram::Outcome& out) { future_.step(out); });
        if (!held) {
            predicted.dates.insert(early.dates.begin(), early.dates.end());
        }
        EXPECT_EQ(predicted.dates, expected.dates) << "known " << known_;
        return predicted.steps;
    }
    dram::Ck known() const { return known_; }
    int held() const { return held_; }

private:
    dram::RuleTable rules_;
    dram::Channel channel_;
    dram::Future future_;
    std::uint32_t next_id_ = 0;
    dram::Ck known_ = 0;
    int held_ = 0;
};

dram::Access random_access(std::mt19937& random, dram::Ck date, unsigned writes_of_8) {
    dram::Access access;
    access.date = date;
    access.row = below(random, 3);
    access.bank = static_cast<std::uint8_t>(below(random, 16));
    access.block = static_cast<std::uint8_t>(below(random, 16));
    access.bursts = static_cast<std::uint8_t>(1 + below(random, 3));
    access.write = below(random, 8) < writes_of_8;
    access.urgent = !access.write && below(random, 3) == 0;
    return access;
}

/// Levels of a phase: the same one for all, or several.
void draw_levels(std::mt19937& random, std::vector<dram::Access>& accesses, unsigned levels) {
    for (dram::Access& access : accesses) {
        access.qos = static_cast<std::uint8_t>(access.write ? 0 : below(random, levels) * 5);
    }
}

class SmallRunLpddr5Future : public ::testing::TestWithParam<std::vector<std::string>> {};

// Phases with bursts and pauses, with writes alone, reads alone and every mix.
TEST_P(SmallRunLpddr5Future, IsThatOfAFreshCopy) {
    const dram::Config config = test::lpddr5_config("lpddr5-6400x256", GetParam());
    Pair pair(config);
    std::mt19937 random(7);
    for (int phase = 0; phase < 50; ++phase) {
        const unsigned writes = below(random, 9), most = 1U << below(random, 7);
        const unsigned pause = below(random, 4) == 0 ? 400 : 1 + below(random, 30);
        const unsigned levels = 1U << below(random, 3);
        for (int batch = 0; batch < 12 && !::testing::Test::HasFailure(); ++batch) {
            dram::Ck date = pair.known() + 1 + below(random, pause);
            std::vector<dram::Access> accesses(1 + below(random, most));
            for (dram::Access& access : accesses) {
                date += below(random, 8) == 0 ? 1 : 0;
                access = random_access(random, date, writes);
            }
            draw_levels(random, accesses, levels);
            pair.expect_equal(accesses);
        }
    }
    EXPECT_GT(pair.held(), 30);
}

INSTANTIATE_TEST_SUITE_P(
    Controllers, SmallRunLpddr5Future,
    ::testing::Values(
        std::vector<std::string>{}, std::vector<std::string>{"controller.posted_writes=false"},
        std::vector<std::string>{"controller.refresh=per_bank", "controller.write_queue=4"},
        std::vector<std::string>{"controller.scheduler=fcfs", "controller.page_policy=closed"},
        std::vector<std::string>{"controller.scheduler=frfcfs_cap",
                                 "controller.frfcfs_cap.row_hits=2"},
        std::vector<std::string>{"controller.write_low=0", "controller.write_high=1",
                                 "controller.read_queue=2", "controller.qos_step=3"}));

// Every posted write is answered when the queue has it, behind all that wait already.
TEST(Lpddr5Future, RunsThroughABacklogOfWritesOnce) {
    Pair pair(test::lpddr5_config("lpddr5-6400x256"));
    constexpr int kWrites = 2000;
    int steps = 0;
    for (std::uint32_t i = 0; i < kWrites; ++i) {
        dram::Access access;
        access.date = pair.known() + 1; // four times as fast as the bus takes them
        access.row = i / 128;
        access.bank = static_cast<std::uint8_t>(i / 8 % 16);
        access.block = static_cast<std::uint8_t>(i / 128 * 8 % 32 + i % 8);
        access.bursts = 3;
        access.write = true;
        steps += pair.expect_equal({access});
    }
    EXPECT_LT(steps, 8 * kWrites);
}

} // namespace
} // namespace degs
