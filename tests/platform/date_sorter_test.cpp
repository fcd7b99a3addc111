// SPDX-License-Identifier: Apache-2.0
#include "degs/date_sorter.hpp"

#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "tests/platform/accelerator_bench.hpp"
#include "tests/tlm/script.hpp"

namespace degs::test {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

sc_core::sc_time ns(double time) {
    return {time, sc_core::SC_NS};
}

double now_ns() {
    return sc_core::sc_time_stamp() / ns(1);
}

/// An initiator whose accesses any thread may make.
struct Master : sc_core::sc_module {
    tlm_utils::simple_initiator_socket<Master> out;
    explicit Master(const sc_core::sc_module_name& name) : sc_core::sc_module(name), out("out") {}

    struct Answer {
        double at = 0, delay = 0; // ns
        tlm::tlm_response_status status = tlm::TLM_INCOMPLETE_RESPONSE;
        bool dmi = false;
    };
    Answer read(std::uint64_t address, double delay_ns) {
        tlm::tlm_generic_payload payload;
        aim(payload, address);
        sc_core::sc_time delay = ns(delay_ns);
        out->b_transport(payload, delay);
        return {now_ns(), delay / ns(1), payload.get_response_status(), payload.is_dmi_allowed()};
    }
    void aim(tlm::tlm_generic_payload& payload, std::uint64_t address) {
        payload.set_command(tlm::TLM_READ_COMMAND);
        payload.set_address(address);
        payload.set_data_ptr(&byte_);
        payload.set_data_length(1);
        payload.set_streaming_width(1);
    }

private:
    unsigned char byte_ = 0;
};

/// Three masters before a memory of 50 ns, which notes when which address is called.
struct SortedMemory {
    explicit SortedMemory(Timing timing = Timing::Annotated) : memory("memory", 4096, timing) {
        for (int i = 0; i < 3; ++i) {
            masters.emplace_back(("master" + std::to_string(i)).c_str());
            masters.back().out.bind(sorter.in[i]);
        }
        sorter.out.bind(memory.in);
        memory.on_range = [this](std::uint64_t address, std::uint64_t) {
            calls.emplace_back(now_ns(), address);
        };
    }
    /// A thread that starts with the simulation.
    void thread(std::function<void()> body) {
        scripts.emplace_back(("script" + std::to_string(scripts.size())).c_str(), std::move(body));
    }
    DateSorter<> sorter{"sorter", 3};
    PlainMemory memory;
    std::deque<Master> masters;
    std::deque<Script> scripts;
    std::vector<std::pair<double, std::uint64_t>> calls; // ns, address
};

TEST(SmallRunDateSorter, CallsInTheOrderOfDates) {
    SortedMemory platform;
    platform.thread([&] { platform.masters[0].read(1, 500); });
    platform.thread([&] { platform.masters[0].read(2, 300); }); // of the same socket
    platform.thread([&] {
        sc_core::wait(ns(100));
        platform.masters[1].read(3, 0);
        platform.masters[1].read(4, 250);
    });
    sc_core::sc_start();
    EXPECT_THAT(platform.calls,
                ElementsAre(Pair(100, 3), Pair(300, 2), Pair(350, 4), Pair(500, 1)));
}

// Also one of a delta cycle later, as behind an edge of a clock, whether its process runs before
// the others or after them.
TEST(SmallRunDateSorter, CallsEqualDatesInTheOrderOfSocketsAndCalls) {
    SortedMemory platform;
    const auto late = [&](double date) {
        platform.thread([&platform, date] {
            sc_core::wait(ns(date));
            sc_core::wait(sc_core::SC_ZERO_TIME);
            platform.masters[0].read(1, 0);
        });
    };
    late(100);
    for (const double date : {100, 200}) {
        platform.thread([&platform, date] { platform.masters[2].read(4, date); });
        platform.thread([&platform, date] { platform.masters[1].read(2, date); });
        platform.thread([&platform, date] {
            sc_core::wait(ns(50));
            platform.masters[1].read(3, date - 50);
        });
    }
    late(200);
    sc_core::sc_start();
    EXPECT_THAT(platform.calls,
                ElementsAre(Pair(100, 1), Pair(100, 2), Pair(100, 3), Pair(100, 4), Pair(200, 1),
                            Pair(200, 2), Pair(200, 3), Pair(200, 4)));
}

TEST(SmallRunDateSorter, KeepsAnnotatedDelaysAndRefusals) {
    SortedMemory platform;
    Master::Answer good;
    Master::Answer bad;
    platform.thread([&] {
        good = platform.masters[0].read(1, 200);
        bad = platform.masters[0].read(1U << 20U, 0);
    });
    sc_core::sc_start();
    EXPECT_EQ(good.at, 200);
    EXPECT_EQ(good.delay, 50);
    EXPECT_EQ(good.status, tlm::TLM_OK_RESPONSE);
    EXPECT_EQ(bad.status, tlm::TLM_ADDRESS_ERROR_RESPONSE);
}

TEST(SmallRunDateSorter, TakesInAccessesWhileTheMemoryWaits) {
    SortedMemory platform(Timing::Blocking);
    std::vector<double> answers(3);
    for (std::size_t i = 0; i < 3; ++i) {
        platform.thread([&platform, &answers, i] {
            const Master::Answer answer =
                platform.masters[i].read(i, 100 + 10 * static_cast<double>(i / 2));
            answers[i] = answer.at + answer.delay;
        });
    }
    sc_core::sc_start();
    EXPECT_THAT(platform.calls, ElementsAre(Pair(100, 0), Pair(100, 1), Pair(110, 2)));
    EXPECT_THAT(answers, ElementsAre(150, 150, 160));
}

TEST(SmallRunDateSorter, PassesDebugTransportAndRefusesDirectMemory) {
    SortedMemory platform;
    bool hint = true;
    bool granted = true;
    unsigned int bytes = 0;
    platform.thread([&] {
        Master& master = platform.masters[1];
        hint = master.read(1, 0).dmi; // which the memory sets
        tlm::tlm_generic_payload payload;
        master.aim(payload, 7);
        bytes = master.out->transport_dbg(payload);
        tlm::tlm_dmi dmi;
        granted = master.out->get_direct_mem_ptr(payload, dmi);
    });
    sc_core::sc_start();
    EXPECT_EQ(bytes, 1U);
    EXPECT_FALSE(granted);
    EXPECT_FALSE(hint);
}

// A thread that is killed between its date and its call must not hold up the others.
TEST(SmallRunDateSorter, ForgetsAThreadThatIsKilled) {
    SortedMemory platform;
    platform.thread([&] {
        auto first = sc_core::sc_spawn([&] { platform.masters[0].read(1, 100); });
        sc_core::wait(ns(100));
        sc_core::wait(sc_core::SC_ZERO_TIME);
        first.kill();
    });
    platform.thread([&] { platform.masters[1].read(2, 100); });
    platform.thread([&] { platform.masters[2].read(3, 100); });
    sc_core::sc_start();
    EXPECT_THAT(platform.calls, ElementsAre(Pair(100, 2), Pair(100, 3)));
}

} // namespace
} // namespace degs::test
