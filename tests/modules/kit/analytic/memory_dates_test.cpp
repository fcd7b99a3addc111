// SPDX-License-Identifier: Apache-2.0
// The memory and the fetcher of an estimate against dates worked out by hand.
#include "modules/kit/analytic/memory_dates.hpp"

#include <gtest/gtest.h>

namespace degs {
namespace {

constexpr double kRate = 64, kLatency = 100; // bytes per cycle, cycles

TEST(MemoryDates, AnswersAfterTransferAndLatency) {
    MemoryDates memory(kRate, kLatency);
    EXPECT_EQ(memory.answer(10, 640), 120);
    EXPECT_EQ(memory.answer(10, 640), 130) << "behind the first one";
    EXPECT_EQ(memory.answer(500, 640), 610);
}

TEST(MemoryDates, ServesInTheOrderOfDates) {
    MemoryDates memory(kRate, kLatency);
    memory.post(50, 64 * 200);
    memory.post(20, 64 * 5);
    EXPECT_EQ(memory.answer(10, 64), 111) << "nothing has been posted yet";
    EXPECT_EQ(memory.answer(22, 64), 126) << "behind the burst of 20 to 25";
    EXPECT_EQ(memory.answer(60, 64), 351) << "behind that of 50 to 250";
    EXPECT_EQ(memory.answer(30, 64), 131) << "asked for before the burst began";
}

TEST(FetcherDates, HasSoManyRequestsInFlight) {
    MemoryDates memory(kRate, kLatency);
    FetcherDates fetcher(8, 2);
    EXPECT_EQ(fetcher.next(memory, 64), 103) << "it asks at 2";
    EXPECT_EQ(fetcher.next(memory, 64), 105);
    EXPECT_EQ(fetcher.next(memory, 64), 204) << "it asks at 103";
}

TEST(FetcherDates, WaitsForAPlace) {
    MemoryDates memory(kRate, kLatency);
    FetcherDates fetcher(1, 8);
    EXPECT_EQ(fetcher.next(memory, 64), 103);
    fetcher.take(700);
    EXPECT_EQ(fetcher.next(memory, 64), 801);
}

// Who waits for its data loses what a burst takes, less what would have been on its way anyway.
TEST(FetcherDates, LosesWhatABurstTakes) {
    const auto last_of = [](double burst) {
        MemoryDates memory(kRate, kLatency);
        FetcherDates fetcher(1000, 1);
        memory.post(500, 64 * burst);
        double date = 0;
        for (int chunk = 0; chunk < 20; ++chunk) {
            date = fetcher.next(memory, 64);
            fetcher.take(date);
        }
        return date;
    };
    EXPECT_EQ(last_of(0), 2 + 20 * 101);
    // The chunk of 507 waits until 1500.
    EXPECT_EQ(last_of(1000), last_of(0) + 1500 - 507);
}

} // namespace
} // namespace degs
