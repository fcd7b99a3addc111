// SPDX-License-Identifier: Apache-2.0
// Scattered records in one request: each is read in its own row of its own channel.
#include "tests/dram/bench.hpp"
#include "tlm/memory_port.hpp"
#include "tlm/scattered_records.hpp"

namespace degs {
namespace {

using test::below;
using test::lpddr5_without_refresh;
using test::Lpddr5Bench;
using test::Script;

ScatteredRecords records_at(std::uint64_t base, const std::vector<std::uint32_t>& numbers,
                            std::uint64_t bytes = 64) {
    ScatteredRecords records;
    records.base = base;
    records.stride = records.bytes = bytes;
    records.numbers = numbers.data();
    records.count = numbers.size();
    return records;
}

/// Runs until every pushed request is complete; returns the date of the last answer of `id`.
dram::Ck completion(dram::Channels& channels, std::uint32_t ids) {
    std::vector<dram::Ck> dates(ids, 0);
    for (dram::Ck due = channels.due(); due != dram::kNoDate; due = channels.due()) {
        channels.run(due);
    }
    for (const dram::Answer& answer : channels.completed()) {
        dates[answer.id] = answer.date;
    }
    return *std::max_element(dates.begin(), dates.end());
}

// One request for n records ends when the last of n requests of the same date would, and does the
// same.
TEST(Lpddr5Scattered, ARequestIsCompleteWithItsLastRecord) {
    std::mt19937 random(3);
    for (int round = 0; round < 40; ++round) {
        const dram::Config config = lpddr5_without_refresh();
        dram::Channels together(config);
        dram::Channels apart(config);
        std::vector<std::uint32_t> numbers;
        for (int i = 0; i < 24; ++i) {
            numbers.push_back(below(random, 1U << 20U));
        }
        const ScatteredRecords records = records_at(4096, numbers);
        dram::Request request;
        request.date = 10;
        request.records = &records;
        together.push(request);
        for (std::uint32_t i = 0; i < numbers.size(); ++i) {
            dram::Request one;
            one.date = 10;
            one.id = i;
            one.address = 4096 + std::uint64_t{numbers[i]} * 64;
            one.bytes = 64;
            apart.push(one);
        }
        EXPECT_EQ(completion(together, 1), completion(apart, 24));
        together.settle(100000);
        apart.settle(100000);
        for (std::size_t c = 0; c < together.size(); ++c) {
            EXPECT_EQ(together[c].stats().commands, apart[c].stats().commands);
        }
    }
}

// Data of records, whole bursts in the statistics, and an error if any record lies outside.
TEST(Lpddr5Scattered, MovesTheBytesOfTheRecordsAndChecksEveryAddress) {
    const Timebase time;
    dram::Lpddr5 memory("memory", lpddr5_without_refresh(), time, 2);
    MemoryPort port("port", time);
    MemoryPort other("other", time);
    port.out.bind(memory.in[0]);
    other.out.bind(memory.in[1]);
    std::vector<std::pair<std::uint64_t, int>> seen;
    port.observe_reads([&](std::uint64_t address, const unsigned char* data, std::uint64_t bytes) {
        EXPECT_EQ(bytes, 24U);
        seen.emplace_back(address, data[23]);
    });
    const std::vector<std::uint32_t> numbers{5000, 2, 70000};
    const std::vector<std::uint32_t> outside{1, 1U << 30U};
    std::string refusal;
    Process self(time);
    const Script script("script", [&] {
        for (const std::uint32_t number : numbers) {
            port.poke(1024 + number * 24, std::vector<unsigned char>(24, (number % 251) & 0xFFU));
        }
        self.advance(1000);
        port.read(self, records_at(1024, numbers, 24));
        self.advance(1000);
        try {
            other.read(self, records_at(0, outside, 24));
        } catch (const std::runtime_error& error) {
            refusal = error.what();
        }
    });
    sc_core::sc_start();
    EXPECT_EQ(seen, (std::vector<std::pair<std::uint64_t, int>>{{1024 + 5000 * 24, 5000 % 251},
                                                                {1024 + 48, 2},
                                                                {1024 + 70000 * 24, 70000 % 251}}));
    EXPECT_EQ(memory.stats(0).reads, 1U);
    // 121024: 32 B * 3782 = 121024, one burst; 1072: 16 B into a burst, 2; 1681024 = 32 * 52532,
    // one.
    EXPECT_EQ(memory.stats(0).bytes_read, 32U * 4);
    EXPECT_EQ(
        memory.transfers(sc_core::sc_time_stamp() + sc_core::sc_time(1, sc_core::SC_US)).total(),
        memory.stats(0).bytes_read);
    EXPECT_NE(refusal.find("TLM_ADDRESS_ERROR_RESPONSE"), std::string::npos) << refusal;
}

// Random records load the channels evenly; as one run from the start of the array they would not.
TEST(Lpddr5Scattered, RandomRecordsLoadAllChannelsAlike) {
    const dram::Config config = lpddr5_without_refresh();
    dram::Channels channels(config);
    std::mt19937 random(9);
    for (int round = 0; round < 400; ++round) {
        std::vector<std::uint32_t> numbers;
        for (int i = 0; i < 16; ++i) {
            numbers.push_back(below(random, 60000));
        }
        const ScatteredRecords records = records_at(0, numbers);
        dram::Request request;
        request.date = 1 + 60 * round;
        request.records = &records;
        channels.push(request);
    }
    channels.settle(1000000);
    std::vector<std::uint64_t> loads;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        loads.push_back(channels[c].stats().column_commands());
    }
    const auto [least, most] = std::minmax_element(loads.begin(), loads.end());
    EXPECT_LT(static_cast<double>(*most), 1.2 * static_cast<double>(*least));
}

} // namespace
} // namespace degs
