// SPDX-License-Identifier: Apache-2.0
// Which writes may answer a read: those that came before it, whatever waits for room meanwhile.
#include <random>

#include "tests/dram/fixture.hpp"

namespace degs {
namespace {

using test::ChannelBench;

/// A read queue of one entry, so that reads wait while writes get in.
class Lpddr5Forward : public ::testing::Test {
protected:
    ChannelBench bench{test::lpddr5_without_refresh({"controller.read_queue=1"})};

    /// Two reads that the third one waits for.
    void keep_reading() {
        bench.push(0, 0, 0, false, 3);
        bench.push(0, 0, 1, false, 3);
    }
    std::uint32_t wanted() { return bench.push(0, 13, 1, false, 3); }
    void overwrite(dram::Ck date, unsigned bursts = 3) { bench.push(date, 13, 1, true, bursts); }
    void expect_read(std::uint32_t id) {
        bench.run_out();
        EXPECT_EQ(bench.answers[id], kAnswer);
        EXPECT_EQ(bench.channel.stats().forwarded, 0U);
    }
    // The second RD of the first read comes at RCD 15 + CCD 4. The row of the second one is opened
    // at RAS 34 + RP 15 and read at 49 + 15 + 4 = 68; the third one gets in a CK later, and ends
    // after RCD 15, CCD 4, RL 17 and BL/n 2.
    static constexpr dram::Ck kAnswer = 107;
};

// The block of the first write has the hash of the read.
TEST_F(Lpddr5Forward, NotFromAYoungerWriteWhateverTheHash) {
    bench.push(0, 6, 3, true, 3, 3);
    keep_reading();
    const auto id = wanted();
    overwrite(20);
    expect_read(id);
}

TEST_F(Lpddr5Forward, NotFromAWriteOfALaterDateThatWasPushedEarlier) {
    overwrite(20);
    keep_reading();
    expect_read(wanted());
}

TEST_F(Lpddr5Forward, NotFromHalfAWriteThatAYoungerOneCompletes) {
    overwrite(0, 1);
    keep_reading();
    const auto id = wanted();
    overwrite(20, 2);
    expect_read(id);
    EXPECT_EQ(bench.channel.stats().merged, 1U);
}

TEST_F(Lpddr5Forward, NotFromAYoungerWriteOfTheSameCk) {
    keep_reading();
    const auto id = wanted();
    overwrite(0);
    expect_read(id);
}

// When the read gets in, both halves are there, and only what is older counts.
TEST_F(Lpddr5Forward, FromOlderWritesAlthoughYoungerOnesJoin) {
    overwrite(0, 1);
    overwrite(0, 2);
    keep_reading();
    const auto id = wanted();
    overwrite(20);
    bench.run_out();
    EXPECT_LT(bench.answers[id], kAnswer);
    EXPECT_EQ(bench.channel.stats().forwarded, 1U);
}

// The block of an access has no part in when it is served, so that other numbers, which have other
// hashes, give the same answers.
TEST(Lpddr5ForwardUnderOverload, DoesNotDependOnTheNumbersOfBlocks) {
    const auto run = [](unsigned shift) {
        ChannelBench bench(test::lpddr5_config("lpddr5-6400x256", {"controller.read_queue=4"}));
        std::mt19937 random(5);
        dram::Ck date = 0;
        for (int i = 0; i < 3000; ++i) {
            date += random() % 16 == 0 ? random() % 300 : random() % 6;
            const unsigned bank = test::below(random, 16);
            const unsigned row = test::below(random, 4);
            const bool write = test::below(random, 2) == 0;
            const unsigned bursts = 1 + test::below(random, 3);
            bench.push(date, bank, row, write, bursts,
                       (7 * test::below(random, 4) + shift * bank) % 32);
        }
        bench.run_out();
        EXPECT_GT(bench.channel.stats().forwarded, 0U);
        return bench.answers;
    };
    const auto answers = run(0);
    for (const unsigned shift : {5U, 11U, 21U}) {
        EXPECT_EQ(run(shift), answers) << shift;
    }
}

} // namespace
} // namespace degs
