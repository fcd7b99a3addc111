// SPDX-License-Identifier: Apache-2.0
// The memory seen by LT initiators, and what both share: contents, errors, debug, DMI, energy.
#include <random>

#include <sys/wait.h>
#include <unistd.h>

#include "tests/dram/bench.hpp"
#include "tlm/has_process.hpp"
#include "tlm/memory_port.hpp"

namespace degs {
namespace {

using sc_core::sc_time;
using sc_core::sc_time_stamp;
using test::AtInitiator;
using test::lpddr5_without_refresh;
using test::Lpddr5Bench;
using test::Script;

const sc_time kCkTime(1.25, sc_core::SC_NS);

// The delay that comes in is part of the date, and the call returns within a cycle of that date.
TEST(Lpddr5Lt, AnnotatesTheClosedForm) {
    Lpddr5Bench bench(lpddr5_without_refresh(), 0, 1);
    unsigned char data[64];
    const Script script("script", [&] {
        for (const int ck : {0, 200, 1000}) {
            const sc_time date = sc_time_stamp() + ck * kCkTime;
            const sc_time on_grid = std::ceil(date / kCkTime - 1e-9) * kCkTime;
            const auto answer =
                bench.lt[0]->access(tlm::TLM_READ_COMMAND, 0, data, 64, ck * kCkTime);
            const int row = ck == 0 ? 15 : 0;
            EXPECT_EQ(answer.done, on_grid + (row + 17 + 2 + 4) * kCkTime);
            EXPECT_LT(sc_time_stamp(), date + sc_time(1, sc_core::SC_NS));
            sc_core::wait(answer.done - sc_time_stamp());
        }
    });
    sc_core::sc_start();
    EXPECT_EQ(bench.memory.total().reads, 3U);
}

/// When `count` reads of 256 B, one per 10 ns, are complete; in ps.
std::vector<std::uint64_t> pipelined(bool at) {
    Lpddr5Bench bench(lpddr5_without_refresh({"waiting_requests=1000"}), at ? 1 : 0, at ? 0 : 1);
    constexpr unsigned kCount = 200;
    std::vector<std::uint64_t> done;
    std::vector<unsigned char> data(256);
    const auto address = [](std::uint64_t i) { return i * 7919 % 4096 * 65536; };
    std::unique_ptr<Script> script;
    if (at) {
        for (std::uint64_t i = 0; i < kCount; ++i) {
            AtInitiator::Request r;
            r.date_ps = 10000 * (i + 1);
            r.address = address(i);
            r.bytes = 256;
            bench.at[0]->requests.push_back(r);
        }
    } else {
        script = std::make_unique<Script>("script", [&] {
            for (std::uint64_t i = 0; i < kCount; ++i) {
                const sc_time date = sc_time::from_value(10000 * (i + 1));
                done.push_back(bench.lt[0]
                                   ->access(tlm::TLM_READ_COMMAND, address(i), data.data(), 256,
                                            date - sc_time_stamp())
                                   .done.value());
            }
        });
    }
    sc_core::sc_start();
    for (const auto& r : at ? bench.at[0]->requests : std::vector<AtInitiator::Request>()) {
        done.push_back(r.answered_ps);
    }
    return done;
}

std::vector<std::uint64_t> dates_in_child(bool at) {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const auto done = pipelined(at);
        const auto bytes = static_cast<ssize_t>(done.size() * sizeof done[0]);
        ::_exit(::write(ends[1], done.data(), static_cast<std::size_t>(bytes)) == bytes ? 0 : 1);
    }
    std::vector<std::uint64_t> done(200);
    EXPECT_EQ(::read(ends[0], done.data(), done.size() * 8), static_cast<ssize_t>(done.size() * 8));
    ::waitpid(child, nullptr, 0);
    return done;
}

// Where no later request overtakes, what is predicted at the request is what happens.
TEST(Lpddr5Lt, PredictsWhatAtInitiatorsSee) {
    const auto lt = dates_in_child(false);
    const auto at = dates_in_child(true);
    std::size_t equal = 0;
    double difference = 0;
    double latency = 0;
    for (std::size_t i = 0; i < lt.size(); ++i) {
        equal += lt[i] == at[i] ? 1 : 0;
        difference += std::abs(static_cast<double>(lt[i]) - static_cast<double>(at[i]));
        latency += static_cast<double>(at[i]) - 10000.0 * static_cast<double>(i + 1);
    }
    EXPECT_GE(equal, lt.size() * 9 / 10);
    EXPECT_LT(difference, 0.02 * latency);
}

// A long run of reads that all come at once cannot be predicted faster than the bus is.
TEST(Lpddr5Lt, BacklogIsServedAtThePeakAtMost) {
    Lpddr5Bench bench(test::lpddr5_config("lpddr5-6400x256"), 0, 1);
    std::vector<unsigned char> data(1U << 20U);
    const Script script("script", [&] {
        const auto answer = bench.lt[0]->access(tlm::TLM_READ_COMMAND, 0, data.data(), 1U << 20U);
        const double ns = answer.done.to_seconds() * 1e9;
        EXPECT_LE((1U << 20U) / ns, 204.8);
        EXPECT_GE((1U << 20U) / ns, 0.9 * 204.8);
    });
    sc_core::sc_start();
}

TEST(Lpddr5Lt, WorksBehindAMemoryPort) {
    struct Block : sc_core::sc_module {
        MemoryPort port;
        Process process;
        std::vector<Cycle> done;
        Block(const sc_core::sc_module_name& name, const Timebase& time)
            : sc_core::sc_module(name), port("port", time), process(time) {
            DEGS_HAS_PROCESS(Block);
            SC_THREAD(run);
        }
        void run() {
            for (std::uint64_t i = 0; i < 20; ++i) {
                done.push_back(port.read(process, i * 64, 64).date());
                process.advance(2);
            }
            process.finish();
        }
    };
    const Timebase time;
    dram::Lpddr5 memory("memory", lpddr5_without_refresh(), time, 1);
    Block block("block", time);
    block.port.out.bind(memory.in[0]);
    sc_core::sc_start();
    ASSERT_EQ(block.done.size(), 20U);
    EXPECT_EQ(block.done[0], 48U); // 38 CK = 47.5 ns
    EXPECT_LT(block.done[19], 20 * 2 + 100U) << "requests of one process overlap";
}

// Random writes and reads by everybody against a plain array.
TEST(Lpddr5Lt, ContentsFollowTheOrderOfDates) {
    Lpddr5Bench bench(lpddr5_without_refresh(), 0, 1);
    std::vector<unsigned char> shadow(20000, 0);
    const Script script("script", [&] {
        std::mt19937 random(2);
        for (int i = 0; i < 400; ++i) {
            const std::uint64_t address = test::below(random, 19000);
            std::vector<unsigned char> data(1 + test::below(random, 900));
            const auto bytes = static_cast<unsigned>(data.size());
            if (test::below(random, 2) == 0) {
                for (auto& byte : data) {
                    byte = static_cast<unsigned char>(random());
                }
                std::copy(data.begin(), data.end(),
                          shadow.begin() + static_cast<std::ptrdiff_t>(address));
                bench.lt[0]->access(tlm::TLM_WRITE_COMMAND, address, data.data(), bytes);
            } else {
                bench.lt[0]->access(tlm::TLM_READ_COMMAND, address, data.data(), bytes);
                ASSERT_TRUE(std::equal(data.begin(), data.end(),
                                       shadow.begin() + static_cast<std::ptrdiff_t>(address)));
            }
        }
        std::vector<unsigned char> all(shadow.size());
        EXPECT_EQ(bench.lt[0]->debug(tlm::TLM_READ_COMMAND, 0, all.data(), 20000), 20000U);
        EXPECT_EQ(all, shadow);
    });
    sc_core::sc_start();
}

TEST(Lpddr5Lt, TimingOnlyTakesTimeAndKeepsNothing) {
    Lpddr5Bench bench(lpddr5_without_refresh(), 0, 1);
    TimingOnly timing_only;
    const Script script("script", [&] {
        unsigned char data[64] = {7};
        const auto write = bench.lt[0]->access(tlm::TLM_WRITE_COMMAND, 0, data, 64,
                                               sc_core::SC_ZERO_TIME, &timing_only);
        EXPECT_GT(write.done, sc_core::SC_ZERO_TIME);
        bench.lt[0]->access(tlm::TLM_READ_COMMAND, 0, data, 64);
        EXPECT_EQ(data[0], 0);
    });
    sc_core::sc_start();
}

TEST(HostileLpddr5, AnswersMistakesWithErrors) {
    Lpddr5Bench bench(lpddr5_without_refresh(), 0, 1);
    const Script script("script", [&] {
        const std::uint64_t capacity = bench.memory.channels().mapping().capacity();
        unsigned char data[64] = {};
        const auto status = [&](tlm::tlm_command command, std::uint64_t address, unsigned bytes) {
            return bench.lt[0]->access(command, address, data, bytes).status;
        };
        EXPECT_EQ(status(tlm::TLM_IGNORE_COMMAND, 0, 64), tlm::TLM_COMMAND_ERROR_RESPONSE);
        EXPECT_EQ(status(tlm::TLM_READ_COMMAND, 0, 0), tlm::TLM_BURST_ERROR_RESPONSE);
        EXPECT_EQ(status(tlm::TLM_READ_COMMAND, capacity, 64), tlm::TLM_ADDRESS_ERROR_RESPONSE);
        EXPECT_EQ(status(tlm::TLM_WRITE_COMMAND, capacity - 63, 64),
                  tlm::TLM_ADDRESS_ERROR_RESPONSE);
        EXPECT_EQ(status(tlm::TLM_READ_COMMAND, ~std::uint64_t{0}, 64),
                  tlm::TLM_ADDRESS_ERROR_RESPONSE);
        EXPECT_EQ(status(tlm::TLM_READ_COMMAND, capacity - 64, 64), tlm::TLM_OK_RESPONSE);
        EXPECT_EQ(bench.lt[0]->debug(tlm::TLM_READ_COMMAND, capacity - 10, data, 64), 10U);
        EXPECT_EQ(bench.lt[0]->debug(tlm::TLM_READ_COMMAND, capacity, data, 64), 0U);

        tlm::tlm_generic_payload payload;
        unsigned char enable = TLM_BYTE_ENABLED; // of an array without length
        test::Initiator::fill(payload, tlm::TLM_READ_COMMAND, 0, data, 64);
        payload.set_byte_enable_ptr(&enable);
        sc_time delay;
        bench.lt[0]->out->b_transport(payload, delay);
        EXPECT_EQ(payload.get_response_status(), tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
        tlm::tlm_phase phase = tlm::BEGIN_REQ;
        EXPECT_EQ(bench.lt[0]->out->nb_transport_fw(payload, phase, delay), tlm::TLM_COMPLETED);
        EXPECT_EQ(payload.get_response_status(), tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE);
    });
    sc_core::sc_start();
    EXPECT_EQ(bench.memory.total().reads, 1U);
}

TEST(Lpddr5Lt, DmiIsGrantedOnlyIfConfigured) {
    dram::Config with = lpddr5_without_refresh({"dmi=true"});
    Lpddr5Bench bench(with, 0, 1);
    const Script script("script", [&] {
        unsigned char data[4] = {1, 2, 3, 4};
        bench.lt[0]->access(tlm::TLM_WRITE_COMMAND, 10000, data, 4);
        tlm::tlm_generic_payload payload;
        test::Initiator::fill(payload, tlm::TLM_READ_COMMAND, 10000, data, 4);
        tlm::tlm_dmi dmi;
        ASSERT_TRUE(bench.lt[0]->out->get_direct_mem_ptr(payload, dmi));
        ASSERT_LE(dmi.get_start_address(), 10000U);
        ASSERT_GE(dmi.get_end_address(), 10003U);
        EXPECT_EQ(dmi.get_dmi_ptr()[10000 - dmi.get_start_address() + 2], 3);
        EXPECT_EQ(dmi.get_read_latency(), 19 * kCkTime);
        dmi.get_dmi_ptr()[10001 - dmi.get_start_address()] = 9;
        bench.lt[0]->access(tlm::TLM_READ_COMMAND, 10000, data, 4);
        EXPECT_EQ(data[1], 9);
    });
    sc_core::sc_start();
}

TEST(Lpddr5Lt, DmiIsRefusedByDefault) {
    Lpddr5Bench bench(lpddr5_without_refresh(), 0, 1);
    tlm::tlm_generic_payload payload;
    unsigned char data[4];
    test::Initiator::fill(payload, tlm::TLM_READ_COMMAND, 0, data, 4);
    tlm::tlm_dmi dmi;
    EXPECT_FALSE(bench.lt[0]->out->get_direct_mem_ptr(payload, dmi));
}

// One access of 64 B in 1 us: one activation, 512 bits, no refresh, standby with a row open.
TEST(Lpddr5Lt, EnergyIsEventsTimesConstants) {
    Lpddr5Bench bench(lpddr5_without_refresh({"channels=1"}), 0, 1);
    const Script script("script", [&] {
        unsigned char data[64];
        bench.lt[0]->access(tlm::TLM_READ_COMMAND, 0, data, 64);
        sc_core::wait(sc_time(1000, sc_core::SC_NS) - sc_time_stamp());
        const dram::Energy energy = bench.memory.energy();
        EXPECT_DOUBLE_EQ(energy.activate_nj, 1.0);
        EXPECT_DOUBLE_EQ(energy.read_nj, 2.75e-3 * 512);
        EXPECT_EQ(energy.write_nj + energy.refresh_nj, 0.0);
        EXPECT_NEAR(energy.background_nj, 30.0, 0.05); // 30 mW for 1 us
    });
    sc_core::sc_start();
}

} // namespace
} // namespace degs
