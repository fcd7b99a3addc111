// SPDX-License-Identifier: Apache-2.0
#include "tlm/scattered_records.hpp"

#include <map>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace degs {
namespace {

using Runs = std::vector<std::pair<std::uint64_t, std::uint64_t>>; // address, bytes

Runs runs_of(const ScatteredRecords& records) {
    Runs runs;
    records.for_each_run(
        [&](std::uint64_t address, std::uint64_t bytes) { runs.emplace_back(address, bytes); });
    return runs;
}

/// Records of `bytes` B, back to back from 1000 on, in bursts of 64 B.
ScatteredRecords records_of(std::uint64_t bytes, const std::vector<std::uint32_t>& numbers) {
    ScatteredRecords records;
    records.base = 1000;
    records.stride = records.bytes = bytes;
    records.burst = 64;
    records.numbers = numbers.data();
    records.count = numbers.size();
    return records;
}

TEST(ScatteredRecords, EveryRecordTakesTheWholeBurstsThatItTouches) {
    const std::vector<std::uint32_t> numbers{3, 0, 1};
    EXPECT_EQ(runs_of(records_of(32, numbers)), (Runs{{1064, 64}, {1000, 64}, {1000, 64}}));
    // 48 B: number 1 lies from 48 to 96 and straddles two bursts, number 3 from 144 to 192 does
    // not.
    EXPECT_EQ(runs_of(records_of(48, numbers)), (Runs{{1128, 64}, {1000, 64}, {1000, 128}}));
}

TEST(ScatteredRecords, NeighboursShareTheBurstBetweenThem) {
    const std::vector<std::uint32_t> numbers{0, 1, 2, 9};
    ScatteredRecords records = records_of(48, numbers);
    records.neighbours_share = true;
    EXPECT_EQ(runs_of(records), (Runs{{1000, 192}, {1000 + 384, 128}}));
    EXPECT_EQ(records.total_bytes(), 320U);
}

TEST(ScatteredRecords, PlacesAndStridesAreFollowedAndBurstsEndWithTheArray) {
    const std::vector<std::uint32_t> places{7, 5, 6};
    const std::vector<std::uint32_t> numbers{2, 0};
    ScatteredRecords records = records_of(8, numbers);
    records.stride = 20;
    records.places = places.data();
    records.array_bytes = 7 * 20 + 8;
    // Places 6 and 7: from 120 to 128, and from 140 to 148, where the array ends.
    EXPECT_EQ(runs_of(records), (Runs{{1064, 64}, {1128, 20}}));
}

TEST(ScatteredRecords, NoneHaveNoRuns) {
    const std::vector<std::uint32_t> numbers;
    EXPECT_TRUE(runs_of(records_of(32, numbers)).empty());
    EXPECT_EQ(records_of(32, numbers).total_bytes(), 0U);
}

// Against a map of bytes: what is moved contains every record, whole bursts only, and the sum is
// right.
TEST(ScatteredRecords, MoveEveryRecordAndNothingButItsBursts) {
    std::mt19937 random(5);
    for (int round = 0; round < 500; ++round) {
        std::vector<std::uint32_t> numbers;
        for (std::uint32_t number = 0; number < 40; ++number) {
            if (random() % 3 == 0) {
                numbers.push_back(number);
            }
        }
        ScatteredRecords records = records_of(1 + random() % 90, numbers);
        records.stride = records.bytes + random() % 2 * (random() % 30);
        records.burst = std::vector<std::uint64_t>{1, 32, 64, 100}[random() % 4];
        records.array_bytes = 39 * records.stride + records.bytes;
        records.neighbours_share = random() % 2 == 0;
        std::map<std::uint64_t, int> moved;
        std::uint64_t bytes = 0;
        records.for_each_run([&](std::uint64_t address, std::uint64_t run) {
            ASSERT_EQ((address - 1000) % records.burst, 0U);
            ASSERT_LE(address + run, 1000 + records.array_bytes);
            bytes += run;
            for (std::uint64_t at = address; at < address + run; ++at) {
                ++moved[at];
            }
        });
        EXPECT_EQ(records.total_bytes(), bytes);
        std::map<std::uint64_t, int> needed; // bursts
        for (const std::uint32_t number : numbers) {
            const std::uint64_t first = number * records.stride;
            for (std::uint64_t b = first / records.burst;
                 b <= (first + records.bytes - 1) / records.burst; ++b) {
                ++needed[b];
            }
        }
        std::uint64_t expected = 0;
        for (const auto& [burst, times] : needed) {
            const std::uint64_t begin = burst * records.burst;
            const std::uint64_t size = std::min(begin + records.burst, records.array_bytes) - begin;
            expected += size * (records.neighbours_share ? 1 : times);
            EXPECT_EQ(moved[1000 + begin], records.neighbours_share ? 1 : times);
        }
        EXPECT_EQ(bytes, expected);
    }
}

} // namespace
} // namespace degs
