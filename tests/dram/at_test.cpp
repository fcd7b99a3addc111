// SPDX-License-Identifier: Apache-2.0
// The memory seen by AT initiators: dates, protocol, back-pressure, order, conservation.
#include <random>

#include <sys/wait.h>
#include <unistd.h>

#include "tests/dram/bench.hpp"

namespace degs {
namespace {

using test::AtInitiator;
using test::Command;
using test::lpddr5_without_refresh;
using test::Lpddr5Bench;

constexpr std::uint64_t kCkPs = 1250; // ps at 6400 MT/s

AtInitiator::Request request(std::uint64_t date_ps, std::uint64_t address, unsigned bytes = 64,
                             bool write = false) {
    AtInitiator::Request r;
    r.date_ps = date_ps;
    r.address = address;
    r.bytes = bytes;
    r.write = write;
    return r;
}

std::vector<AtInitiator::Request> random_requests(unsigned seed, int count, unsigned pause_ps) {
    std::mt19937 random(seed);
    std::vector<AtInitiator::Request> requests;
    std::uint64_t date = 0;
    for (int i = 0; i < count; ++i) {
        date += test::below(random, 8) == 0 ? test::below(random, 40 * pause_ps)
                                            : test::below(random, pause_ps);
        requests.push_back(request(date, test::below(random, 1U << 20U),
                                   1 + test::below(random, 700), test::below(random, 3) == 0));
        requests.back().annotated_ps = std::min<std::uint64_t>(date, test::below(random, 3000));
    }
    return requests;
}

// A request between two CK starts at the next one; 64 B in one group end a tCCD_L later.
TEST(Lpddr5At, UnloadedReadTakesTheClosedForm) {
    Lpddr5Bench bench(lpddr5_without_refresh(), 1, 0);
    bench.at[0]->requests = {request(100 * kCkPs, 0), request(1000 * kCkPs - 7, 64)};
    sc_core::sc_start();
    const auto& got = bench.at[0]->requests;
    EXPECT_EQ(got[0].answered_ps, (100 + 15 + 17 + 2 + 4) * kCkPs);
    EXPECT_EQ(got[1].answered_ps, (1000 + 17 + 2 + 4) * kCkPs);
    EXPECT_EQ(got[0].accepted_ps, got[0].begun_ps);
}

TEST(Lpddr5At, ControllerLatencyIsAddedInWholeCk) {
    Lpddr5Bench bench(lpddr5_without_refresh({"controller_latency_ns=10.1"}), 1, 0);
    bench.at[0]->requests = {request(100 * kCkPs, 0), request(900 * kCkPs, 0, 64, true)};
    sc_core::sc_start();
    EXPECT_EQ(bench.at[0]->requests[0].answered_ps, (100 + 38 + 9) * kCkPs);
    EXPECT_EQ(bench.at[0]->requests[1].answered_ps, (900 + 1 + 9) * kCkPs) << "a posted write";
}

TEST(Lpddr5At, AnnotatedDelayIsPartOfTheDate) {
    Lpddr5Bench bench(lpddr5_without_refresh(), 1, 0);
    bench.at[0]->requests = {request(100 * kCkPs, 0)};
    bench.at[0]->requests[0].annotated_ps = 40 * kCkPs;
    sc_core::sc_start();
    EXPECT_EQ(bench.at[0]->requests[0].answered_ps, (100 + 38) * kCkPs);
}

class Lpddr5AtEndings
    : public ::testing::TestWithParam<std::tuple<AtInitiator::Ending, std::uint64_t, int>> {};

TEST_P(Lpddr5AtEndings, KeepProtocolAndBytes) {
    const auto& [ending, response_ps, waiting] = GetParam();
    Lpddr5Bench bench(
        test::lpddr5_config("lpddr5-6400x256", {"waiting_requests=" + std::to_string(waiting)}), 3,
        0);
    std::uint64_t commands = 0;
    bench.memory.observe([&](unsigned, const dram::Issued& issued) {
        commands += dram::is_column(issued.command) ? 1 : 0;
    });
    for (unsigned i = 0; i < 3; ++i) {
        bench.at[i]->ending = ending;
        bench.at[i]->response_ps = response_ps;
        bench.at[i]->requests = random_requests(i, 600, 900);
    }
    sc_core::sc_start();
    std::uint64_t bytes[2] = {0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
        std::uint64_t reads = 0;
        for (const auto& r : bench.at[i]->requests) {
            EXPECT_EQ(r.answers, 1);
            EXPECT_GE(r.accepted_ps, r.begun_ps);
            EXPECT_GE(r.answered_ps, r.begun_ps + (r.write ? 1 : kCkPs));
            reads += r.write ? 0 : 1;
            bytes[r.write] += ((r.address + r.bytes + 31) / 32 - r.address / 32) * 32;
        }
        EXPECT_EQ(bench.memory.stats(i).reads, reads);
        EXPECT_EQ(bench.memory.stats(i).writes, bench.at[i]->requests.size() - reads);
    }
    const dram::Lpddr5::Stats total = bench.memory.total();
    EXPECT_EQ(total.bytes_read, bytes[0]);
    EXPECT_EQ(total.bytes_written, bytes[1]);
    const auto counted = bench.memory.commands();
    const dram::TransferAccount account = bench.memory.transfers(sc_core::sc_time_stamp());
    EXPECT_EQ(account.on_bus, commands * 32);
    EXPECT_EQ(account.total(), bytes[0] + bytes[1]);
    EXPECT_GT(account.merged + account.forwarded, 0U);
    EXPECT_EQ(counted.bursts[0] + counted.bursts[1] + counted.bursts[2], commands);
}

std::string
row_name(const ::testing::TestParamInfo<std::tuple<AtInitiator::Ending, std::uint64_t, int>>& row) {
    constexpr const char* kNames[] = {"Completed", "Updated", "Accepted"};
    const auto [ending, response_ps, waiting] = row.param;
    return kNames[static_cast<std::size_t>(ending)] + std::string("After") +
           std::to_string(response_ps) + "psWaiting" + std::to_string(waiting);
}

INSTANTIATE_TEST_SUITE_P(All, Lpddr5AtEndings,
                         ::testing::Values(std::tuple{AtInitiator::Ending::Completed, 0U, 16},
                                           std::tuple{AtInitiator::Ending::Completed, 0U, 1},
                                           std::tuple{AtInitiator::Ending::Updated, 0U, 16},
                                           std::tuple{AtInitiator::Ending::Updated, 3100U, 2},
                                           std::tuple{AtInitiator::Ending::Accepted, 0U, 1},
                                           std::tuple{AtInitiator::Ending::Accepted, 3100U, 16}),
                         row_name);

// 40 requests to one bank at once: 8 fill the queue, 4 more get END_REQ, the next one has to wait.
TEST(Lpddr5At, WithheldEndReqIsTheBackPressure) {
    const dram::Config small =
        lpddr5_without_refresh({"controller.read_queue=8", "waiting_requests=4"});
    const dram::Mapping mapping(small.mapping, small.timing, 16);
    Lpddr5Bench bench(small, 1, 0);
    for (unsigned row = 0; row < 40; ++row) {
        bench.at[0]->requests.push_back(request(100 * kCkPs, mapping.address({3, 5, row, 0})));
    }
    sc_core::sc_start();
    const auto& got = bench.at[0]->requests;
    for (std::size_t i = 0; i < 12; ++i) {
        EXPECT_LE(got[i].accepted_ps, 102 * kCkPs) << i;
    }
    // One row after the other: a place is free every tRC, when the last burst has been sent.
    for (std::size_t i = 13; i < 40; ++i) {
        EXPECT_EQ(got[i].accepted_ps - got[i - 1].accepted_ps, 49 * kCkPs) << i;
        EXPECT_EQ(got[i].answered_ps - got[i - 1].answered_ps, 49 * kCkPs) << i;
    }
    EXPECT_EQ(bench.at[0]->outstanding_most, 8 + 4 + 2); // one held back, one whose data return
}

// Dates and answers must not depend on the order in which initiators are built, and so
// called.
std::vector<std::uint64_t> answers_in_order(bool reversed) {
    dram::Lpddr5 memory("memory", test::lpddr5_config("lpddr5-6400x256", {"waiting_requests=3"}),
                        {}, 4);
    std::vector<std::unique_ptr<AtInitiator>> initiators(4);
    for (std::size_t n = 0; n < 4; ++n) {
        const std::size_t i = reversed ? 3 - n : n;
        initiators[i] = std::make_unique<AtInitiator>(("at" + std::to_string(i)).c_str());
        initiators[i]->out.bind(memory.in[i]);
        initiators[i]->requests = random_requests(static_cast<unsigned>(i) % 2, 500, 1250);
        for (auto& r : initiators[i]->requests) {
            r.date_ps = r.date_ps / kCkPs * kCkPs; // many equal dates
            r.annotated_ps = i % 2 == 0 ? 0 : std::min(r.date_ps, r.annotated_ps);
        }
    }
    sc_core::sc_start();
    std::vector<std::uint64_t> dates;
    for (const auto& initiator : initiators) {
        for (const auto& r : initiator->requests) {
            dates.push_back(r.answered_ps);
            dates.push_back(r.accepted_ps);
        }
    }
    return dates;
}

/// Hash of the dates of a run in a process of its own.
std::uint64_t in_child(const std::function<std::vector<std::uint64_t>()>& run) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        std::uint64_t h = 0;
        for (const std::uint64_t value : run()) {
            h = test::mix(h, value, 0, 0);
        }
        ::_exit(::write(ends[1], &h, sizeof h) == sizeof h ? 0 : 1);
    }
    std::uint64_t h = 0;
    EXPECT_EQ(::read(ends[0], &h, sizeof h), static_cast<ssize_t>(sizeof h));
    ::waitpid(child, nullptr, 0);
    return h;
}

TEST(Lpddr5At, HostOrderOfEqualDatesDoesNotMatter) {
    const auto built = [](bool reversed) {
        return in_child([reversed] { return answers_in_order(reversed); });
    };
    EXPECT_EQ(built(false), built(true));
}

std::vector<std::uint64_t> answers_while_watched(bool watched) {
    Lpddr5Bench bench(test::lpddr5_config("lpddr5-6400x256"), 2, 0);
    for (unsigned i = 0; i < 2; ++i) {
        bench.at[i]->requests = random_requests(i, 800, 2000);
    }
    const test::Script script("script", [&] {
        for (int i = 0; watched && i < 4000; ++i) {
            sc_core::wait(sc_core::sc_time::from_value(kCkPs / 3 + 100 * (i % 7)));
            bench.memory.commands();
        }
    });
    sc_core::sc_start();
    std::vector<std::uint64_t> dates;
    for (const auto& initiator : bench.at) {
        for (const auto& r : initiator->requests) {
            dates.push_back(r.answered_ps);
        }
    }
    return dates;
}

// Asking for statistics runs every channel up to date; left alone, channels stay behind.
TEST(Lpddr5At, ChannelsThatStayBehindAnswerTheSame) {
    EXPECT_EQ(in_child([] { return answers_while_watched(false); }),
              in_child([] { return answers_while_watched(true); }));
}

// No window of time carries more than the data bus can.
TEST(Lpddr5At, NeverExceedsThePeakInAnyWindow) {
    Lpddr5Bench bench(lpddr5_without_refresh(), 4, 0);
    for (unsigned i = 0; i < 4; ++i) {
        for (std::uint64_t n = 0; n < 400; ++n) {
            bench.at[i]->requests.push_back(request(0, (n * 4 + i) * 512, 512));
        }
    }
    std::vector<std::vector<dram::Ck>> reads(16);
    bench.memory.observe([&](unsigned channel, const dram::Issued& issued) {
        if (issued.command == Command::Rd) {
            reads[channel].push_back(issued.date);
        }
    });
    sc_core::sc_start();
    std::uint64_t all = 0;
    for (const auto& dates : reads) {
        all += dates.size();
        for (std::size_t i = 1; i < dates.size(); ++i) {
            ASSERT_GE(dates[i], dates[i - 1] + 2);
        }
    }
    EXPECT_EQ(all * 32, 4U * 400 * 512);
    const double ns = bench.memory.total().last_answer.to_seconds() * 1e9;
    EXPECT_LE(4.0 * 400 * 512 / ns, 204.8);
    EXPECT_GE(4.0 * 400 * 512 / ns, 0.9 * 204.8);
}

} // namespace
} // namespace degs
