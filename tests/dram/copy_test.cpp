// SPDX-License-Identifier: Apache-2.0
// Predictions run on a channel that is assigned over again and again: nothing of what it was before
// may show, and nothing may be used that is gone. Worth most under the address sanitizer.
#include "tests/dram/fixture.hpp"

namespace degs {
namespace {

using test::below;

/// What a run has brought about, as plain numbers.
std::vector<dram::Ck> plain(const dram::Outcome& outcome) {
    std::vector<dram::Ck> numbers;
    for (const dram::Answer& answer : outcome.answers) {
        numbers.push_back(answer.id);
        numbers.push_back(answer.date);
    }
    numbers.insert(numbers.end(), outcome.admitted.begin(), outcome.admitted.end());
    return numbers;
}

/// Runs a channel until nothing is queued.
std::vector<dram::Ck> run_out(dram::Channel& channel) {
    dram::Outcome outcome;
    while (!channel.idle()) {
        channel.run(channel.next_date(), outcome);
    }
    return plain(outcome);
}

/// Runs a channel by single steps, each of which must come at the date that was announced.
std::vector<dram::Ck> step_out(dram::Channel& channel) {
    dram::Outcome outcome;
    while (!channel.idle()) {
        const dram::Ck next = channel.next_date();
        EXPECT_EQ(channel.step(outcome), next);
    }
    return plain(outcome);
}

void push_some(dram::Channel& channel, std::mt19937& random, dram::Ck& date, unsigned count,
               unsigned blocks = 32) {
    for (unsigned i = 0; i < count; ++i) {
        date += below(random, 3);
        dram::Access access;
        access.date = date;
        access.id = i;
        access.row = below(random, 5);
        access.bank = static_cast<std::uint8_t>(below(random, 16));
        access.block = static_cast<std::uint8_t>(below(random, blocks));
        access.bursts = static_cast<std::uint8_t>(1 + below(random, 3));
        access.write = below(random, 3) == 0;
        channel.push(access);
    }
}

TEST(SmallRunLpddr5Copy, AssignedOverAnyOtherItDoesWhatAFreshCopyDoes) {
    const dram::Config config = test::lpddr5_config("lpddr5-6400x256");
    const dram::RuleTable rules(config.timing);
    const dram::Channel empty(config.timing, rules, config.controller);
    std::vector<dram::Channel> sources(5, empty);
    std::vector<dram::Ck> dates(sources.size(), 0);
    dram::Channel reused = empty;
    std::uint64_t seen = 0;
    reused.observe([&seen](const dram::Issued&) { ++seen; });
    std::mt19937 random(11);
    for (int round = 0; round < 3000; ++round) {
        const unsigned i = below(random, 5);
        // From nothing to hundreds of accesses that wait for room, and now and then a new channel.
        push_some(sources[i], random, dates[i], below(random, 200) == 0 ? 300 : below(random, 6));
        dram::Outcome outcome;
        sources[i].run(dates[i], outcome);
        reused = sources[i];
        reused.observe({});
        const dram::Channel before = sources[i];
        dram::Channel fresh = sources[i];
        ASSERT_EQ(run_out(reused), run_out(fresh)) << "round " << round;
        ASSERT_EQ(reused.stats().commands, fresh.stats().commands);
        ASSERT_EQ(sources[i].waiting(), before.waiting()) << "the source has been touched";
        ASSERT_EQ(sources[i].stats().commands, before.stats().commands);
        if (below(random, 50) == 0) {
            sources[i] = empty;
            dates[i] = 0;
        }
    }
    EXPECT_EQ(seen, 0U) << "an observer has outlived the assignment";
}

// Blocks are few, so that writes merge and reads are answered from them.
TEST(SmallRunLpddr5Copy, DoesStepByStepWhatItDoesInOneRun) {
    const dram::Config config = test::lpddr5_config("lpddr5-6400x256");
    const dram::RuleTable rules(config.timing);
    dram::Channel source(config.timing, rules, config.controller);
    std::mt19937 random(13);
    dram::Ck date = 0;
    for (int round = 0; round < 500; ++round) {
        push_some(source, random, date, below(random, 50) == 0 ? 300 : below(random, 12), 2);
        dram::Outcome outcome;
        source.run(date, outcome);
        dram::Channel running = source;
        dram::Channel stepping = source;
        ASSERT_EQ(step_out(stepping), run_out(running)) << "round " << round;
        ASSERT_EQ(stepping.stats().commands, running.stats().commands);
        ASSERT_EQ(stepping.stats().merged_bursts, running.stats().merged_bursts);
        ASSERT_EQ(stepping.stats().forwarded, running.stats().forwarded);
    }
    EXPECT_GT(source.stats().merged, 0U);
    EXPECT_GT(source.stats().forwarded, 0U);
}

// Predictions through all channels, with requests from 64 B to 64 KiB: one object predicts all the
// time, the other for the first time; both know the same requests.
TEST(SmallRunLpddr5Copy, TheThousandthPredictionIsThatOfOneWhoNeverPredicted) {
    const dram::Config config = test::lpddr5_config("lpddr5-6400x128");
    std::mt19937 random(12);
    for (int attempt = 0; attempt < 8; ++attempt) {
        dram::Channels often(config);
        dram::Channels once(config);
        dram::Ck date = 0;
        for (int round = 0; round < 300; ++round) {
            dram::Request request;
            request.date = date += 1 + below(random, 60);
            request.address = std::uint64_t{below(random, 1U << 20U)} * 64;
            request.bytes = below(random, 20) == 0 ? 65536 : 64 + below(random, 1000);
            request.write = below(random, 4) == 0;
            often.push_for_prediction(request);
            once.push_for_prediction(request);
            const std::vector<dram::Ck> answers = often.predict(date);
            ASSERT_EQ(answers.size(), 1U);
            ASSERT_GT(answers[0], date);
            if (round == 299) {
                // `once` has been asked for all of them now; the last answer is the one to compare.
                const std::vector<dram::Ck> all = once.predict(date);
                ASSERT_EQ(all.size(), 300U);
                EXPECT_EQ(all.back(), answers[0]);
            }
        }
    }
}

} // namespace
} // namespace degs
