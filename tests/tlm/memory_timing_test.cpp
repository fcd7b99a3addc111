// SPDX-License-Identifier: Apache-2.0
// When an access is served: order, latency, bandwidth.
#include <algorithm>
#include <random>
#include <tuple>

#include "tests/tlm/memory_fixture.hpp"

namespace degs {
namespace {

using sc_core::sc_time;
using sc_core::sc_time_stamp;
using test::memory_config;
using test::MemoryBench;
using test::Script;

TEST(Memory, UnloadedLatencyIsLatencyPlusTransfer) {
    MemoryBench bench(memory_config(), 1);
    std::vector<unsigned char> data(4096);
    const Script script("script", [&] {
        for (const unsigned bytes : {64U, 128U, 640U, 4096U}) {
            sc_core::wait(sc_time(1, sc_core::SC_US));
            const sc_time start = sc_time_stamp();
            for (const double delay : {0.0, 200.0, 500.0}) {
                const sc_time date = start + sc_time(delay, sc_core::SC_NS);
                const auto answer = bench[0].access(tlm::TLM_READ_COMMAND, 0, data.data(), bytes,
                                                    date - sc_time_stamp());
                EXPECT_EQ(answer.done - date, sc_time(100 + bytes / 64.0, sc_core::SC_NS));
                EXPECT_EQ(answer.status, tlm::TLM_OK_RESPONSE);
            }
        }
    });
    sc_core::sc_start();
    EXPECT_EQ(bench.memory.total().reads, 12U);
    EXPECT_EQ(bench.memory.total().waited_ns, 0.0);
}

// b_transport comes back within the cycle of the request, so one thread has many in flight.
TEST(Memory, RequestsOfOneInitiatorOverlap) {
    MemoryBench bench(memory_config(), 1);
    std::vector<unsigned char> data(64);
    const Script script("script", [&] {
        for (Cycle i = 0; i < 50; ++i) {
            const sc_time date(static_cast<double>(10 + 2 * i), sc_core::SC_NS);
            const auto answer =
                bench[0].access(tlm::TLM_READ_COMMAND, 0, data.data(), 64, date - sc_time_stamp());
            EXPECT_EQ(answer.done, date + sc_time(101, sc_core::SC_NS));
            EXPECT_LT(sc_time_stamp(), date + sc_time(1, sc_core::SC_NS));
        }
    });
    sc_core::sc_start();
    EXPECT_EQ(bench.memory.stats(0).reads, 50U);
}

/// One request of the random tests and when it was answered.
struct Request {
    std::uint64_t date = 0; ///< ps
    std::size_t socket = 0;
    std::uint64_t address = 0;
    unsigned int bytes = 0;
    bool read = true;
    std::uint64_t done = 0; ///< ps
    double transfer_ps(const Memory::Config& c) const {
        return 1000.0 * occupied(c) / c.bandwidth_gb_per_s;
    }
    double occupied(const Memory::Config& c) const {
        const auto granule = static_cast<std::uint64_t>(c.access_bytes);
        return static_cast<double>(((address + bytes - 1) / granule - address / granule + 1) *
                                   granule);
    }
};

/// Random requests of several sockets in cycles of 1 ns; fills in `done` by running them.
std::vector<Request> run_random(std::size_t sockets, unsigned seed, MemoryBench& bench) {
    std::mt19937 random(seed);
    std::vector<std::vector<Request>> of(sockets);
    for (std::size_t s = 0; s < sockets; ++s) {
        std::uint64_t date = 0;
        for (int i = 0; i < 120; ++i) {
            date += 1000 * (1 + random() % (i / 30 % 2 == 0 ? 2 : 40));
            Request r;
            r.date = date;
            r.socket = s;
            r.address = random() % 5000;
            r.bytes = 1 + static_cast<unsigned int>(random() % 300);
            r.read = random() % 3 != 0;
            of[s].push_back(r);
        }
    }
    std::vector<std::unique_ptr<Script>> scripts;
    for (std::size_t s = sockets; s-- > 0;) { // host order is not socket order
        scripts.push_back(std::make_unique<Script>(("script" + std::to_string(s)).c_str(), [&, s] {
            std::vector<unsigned char> data(300);
            for (Request& r : of[s]) {
                const sc_time delay = sc_time::from_value(r.date) - sc_time_stamp();
                if (s % 2 == 1) {
                    sc_core::wait(delay); // some come in kernel time, some annotate
                }
                const auto answer = bench[s].access(
                    r.read ? tlm::TLM_READ_COMMAND : tlm::TLM_WRITE_COMMAND, r.address, data.data(),
                    r.bytes, s % 2 == 1 ? sc_core::SC_ZERO_TIME : delay);
                r.done = answer.done.value();
            }
        }));
    }
    sc_core::sc_start();
    std::vector<Request> all;
    for (const auto& requests : of) {
        all.insert(all.end(), requests.begin(), requests.end());
    }
    std::sort(all.begin(), all.end(), [](const Request& a, const Request& b) {
        return std::tie(a.date, a.socket) < std::tie(b.date, b.socket);
    });
    return all;
}

class MemoryOf : public ::testing::TestWithParam<std::tuple<double, double, int>> {};

// start = max(date, end of the transfer before) in the order of (date, socket).
TEST_P(MemoryOf, ServesByDateThenSocket) {
    const Memory::Config c = std::apply(memory_config, GetParam());
    MemoryBench bench(c, 5);
    const std::vector<Request> requests = run_random(5, 7, bench);
    double free = 0;
    double busy = 0;
    double waited = 0;
    double bytes[2] = {0, 0};
    for (const Request& r : requests) {
        const double start = std::max(free, static_cast<double>(r.date));
        free = start + r.transfer_ps(c);
        EXPECT_NEAR(static_cast<double>(r.done), free + 1000 * c.latency_ns, 1.01);
        busy += r.transfer_ps(c) / 1000;
        waited += (start - static_cast<double>(r.date)) / 1000;
        bytes[r.read ? 0 : 1] += r.occupied(c);
    }
    const Memory::Stats total = bench.memory.total();
    EXPECT_EQ(total.reads + total.writes, requests.size());
    EXPECT_EQ(static_cast<double>(total.bytes_read), bytes[0]);
    EXPECT_EQ(static_cast<double>(total.bytes_written), bytes[1]);
    EXPECT_NEAR(total.busy_ns, busy, 1e-6 * busy);
    EXPECT_NEAR(total.waited_ns, waited, 1e-6 * waited + 1e-6);
}

// Any window (from, to] of time: the bytes whose transfer lies in it fit the bandwidth.
TEST_P(MemoryOf, NeverExceedsItsBandwidthInAnyWindow) {
    const Memory::Config c = std::apply(memory_config, GetParam());
    MemoryBench bench(c, 3);
    std::vector<Request> requests = run_random(3, 8, bench);
    std::sort(requests.begin(), requests.end(),
              [](const Request& a, const Request& b) { return a.done < b.done; });
    for (std::size_t first = 0; first < requests.size(); ++first) {
        const double from =
            static_cast<double>(requests[first].done) - requests[first].transfer_ps(c);
        double bytes = 0;
        for (std::size_t i = first; i < requests.size(); ++i) {
            bytes += requests[i].occupied(c);
            const double window_ns = (static_cast<double>(requests[i].done) - from + 1) / 1000;
            ASSERT_LE(bytes, window_ns * c.bandwidth_gb_per_s * (1 + 1e-9));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Configs, MemoryOf,
                         ::testing::Values(std::tuple(100.0, 64.0, 64), std::tuple(0.0, 51.2, 32),
                                           std::tuple(37.5, 1.0, 64), std::tuple(100.0, 204.8, 64),
                                           std::tuple(3.0, 10.0, 1)));

// Sockets ask at one date, in any host order; the lower socket is served first.
TEST(Memory, EqualDatesGoBySocket) {
    MemoryBench bench(memory_config(10), 3);
    std::vector<sc_time> done(3);
    std::vector<std::unique_ptr<Script>> scripts;
    for (const std::size_t s : {2U, 0U, 1U}) {
        scripts.push_back(std::make_unique<Script>(("script" + std::to_string(s)).c_str(), [&, s] {
            unsigned char data[64];
            const sc_time early(static_cast<double>(s), sc_core::SC_NS);
            sc_core::wait(early); // kernel times differ, dates do not
            done[s] =
                bench[s]
                    .access(tlm::TLM_READ_COMMAND, 0, data, 64, sc_time(20, sc_core::SC_NS) - early)
                    .done;
        }));
    }
    sc_core::sc_start();
    EXPECT_EQ(done[0], sc_time(31, sc_core::SC_NS));
    EXPECT_EQ(done[1], sc_time(32, sc_core::SC_NS));
    EXPECT_EQ(done[2], sc_time(33, sc_core::SC_NS));
}

} // namespace
} // namespace degs
