// SPDX-License-Identifier: Apache-2.0
// degs::Lpddr5 as programs outside see it: the resolution of time, numbers of initiators, byte
// enables, debug transport and statistics by name.
#include <stdexcept>

#include <gmock/gmock.h>
#include <tlm_utils/simple_initiator_socket.h>

#include "degs/error.hpp"
#include "degs/lpddr5.hpp"
#include "tests/platform/accelerator_bench.hpp"
#include "tests/tlm/script.hpp"

namespace degs::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Reads 64 B of a closed row, then of the row that is open, and keeps the time of each in ps.
class RowReader : public sc_core::sc_module {
public:
    tlm_utils::simple_initiator_socket<RowReader> out;
    std::vector<double> took_ps;

    explicit RowReader(const sc_core::sc_module_name& name) : sc_core::sc_module(name), out("out") {
        DEGS_HAS_PROCESS(RowReader);
        SC_THREAD(run);
    }

private:
    void run() {
        for (int i = 0; i < 2; ++i) {
            unsigned char data[64];
            tlm::tlm_generic_payload payload;
            payload.set_command(tlm::TLM_READ_COMMAND);
            payload.set_address(0);
            payload.set_data_ptr(data);
            payload.set_data_length(sizeof data);
            payload.set_streaming_width(sizeof data);
            sc_core::sc_time delay;
            const sc_core::sc_time begin = sc_core::sc_time_stamp();
            out->b_transport(payload, delay);
            sc_core::wait(delay);
            EXPECT_TRUE(payload.is_response_ok());
            took_ps.push_back(1e12 * (sc_core::sc_time_stamp() - begin).to_seconds());
        }
    }
};

struct Resolution {
    double value;
    sc_core::sc_time_unit unit;
    bool fast, slow; ///< whether it holds the 1250 ps of LPDDR5-6400, and the 2500 ps of -3200
};

class SmallRunLpddr5Resolution : public ::testing::TestWithParam<Resolution> {};

// 64 B are two bursts of a bank group, CCD apart: RCD + RL + CCD + 2 CK after the activation.
TEST_P(SmallRunLpddr5Resolution, DatesAreThoseOfTheDefaultOrRefused) {
    sc_core::sc_set_time_resolution(GetParam().value, GetParam().unit);
    struct Speed {
        const char* name;
        bool held;
        double ck_ps, rcd, hit; ///< CK
    };
    const Speed speeds[] = {{"lpddr5-6400x256", GetParam().fast, 1250, 15, 17 + 4 + 2},
                            {"lpddr5-3200x128", GetParam().slow, 2500, 8, 9 + 2 + 2}};
    for (const Speed& speed : speeds) {
        SCOPED_TRACE(speed.name);
        const std::string file = std::string(DEGS_CONFIGS) + "/memory/" + speed.name + ".yaml";
        const std::string module = "m" + std::to_string(static_cast<int>(speed.ck_ps));
        if (!speed.held) {
            EXPECT_THAT([&] { const Lpddr5 memory(module.c_str(), file, 1); },
                        ThrowsMessage<InputError>(AllOf(HasSubstr(module + ": "),
                                                        HasSubstr("time resolution"),
                                                        HasSubstr(speed.name))));
            continue;
        }
        auto* const memory = new Lpddr5(module.c_str(), file, 1); // lives as long as the kernel
        auto* const reader = new RowReader((module + "_reader").c_str());
        reader->out.bind(memory->in(0));
        sc_core::sc_start(sc_core::sc_time(1, sc_core::SC_US));
        ASSERT_EQ(reader->took_ps.size(), 2U);
        EXPECT_NEAR(reader->took_ps[0], (speed.rcd + speed.hit) * speed.ck_ps, 0.01);
        EXPECT_NEAR(reader->took_ps[1], speed.hit * speed.ck_ps, speed.ck_ps);
        break; // the kernel is elaborated
    }
}

INSTANTIATE_TEST_SUITE_P(Of, SmallRunLpddr5Resolution,
                         ::testing::Values(Resolution{1, sc_core::SC_FS, true, true},
                                           Resolution{1, sc_core::SC_PS, true, true},
                                           Resolution{10, sc_core::SC_PS, true, true},
                                           Resolution{100, sc_core::SC_PS, false, true},
                                           Resolution{1, sc_core::SC_NS, false, false},
                                           Resolution{10, sc_core::SC_NS, false, false}),
                         [](const ::testing::TestParamInfo<Resolution>& which) {
                             return std::to_string(static_cast<int>(which.param.value)) + "_" +
                                    std::to_string(static_cast<int>(which.param.unit));
                         });

TEST(Lpddr5Face, InitiatorsThatDoNotExistAreRefused) {
    for (const std::size_t wrong : {std::size_t{0}, ~std::size_t{0}}) {
        EXPECT_THAT([&] { const Lpddr5 none("none", "", wrong); },
                    ThrowsMessage<InputError>(AllOf(HasSubstr("none: "), HasSubstr("initiators"))));
    }
    Lpddr5 memory("memory", "", 2);
    EXPECT_EQ(memory.statistic("bytes_read", 1), 0);
    const auto refused =
        ThrowsMessage<std::out_of_range>(HasSubstr("memory: there is no initiator 9"));
    EXPECT_THAT([&] { memory.statistic("bytes_read", 9); }, refused);
    EXPECT_THAT([&] { memory.statistics(9); }, refused);
    EXPECT_THAT([&] { memory.in(9); }, refused);
}

/// One access at a time, by b_transport() or by four phases.
class Caller : public sc_core::sc_module, private tlm::tlm_mm_interface {
public:
    tlm_utils::simple_initiator_socket<Caller> out;

    explicit Caller(const sc_core::sc_module_name& name) : sc_core::sc_module(name), out("out") {
        out.register_nb_transport_bw(this, &Caller::backward);
    }
    /// From a thread. Returns when the access is answered.
    tlm::tlm_response_status access(bool four_phases, tlm::tlm_command command,
                                    std::uint64_t address, std::vector<unsigned char>& data,
                                    std::vector<unsigned char>& enables) {
        auto& payload = *new tlm::tlm_generic_payload(this);
        payload.acquire();
        const auto bytes = static_cast<unsigned int>(data.size());
        payload.set_command(command);
        payload.set_address(address);
        payload.set_data_ptr(data.data());
        payload.set_data_length(bytes);
        payload.set_streaming_width(bytes);
        payload.set_byte_enable_ptr(enables.empty() ? nullptr : enables.data());
        payload.set_byte_enable_length(static_cast<unsigned int>(enables.size()));
        sc_core::sc_time delay;
        if (four_phases) {
            tlm::tlm_phase phase = tlm::BEGIN_REQ;
            if (out->nb_transport_fw(payload, phase, delay) != tlm::TLM_COMPLETED) {
                sc_core::wait(answered_);
            }
        } else {
            out->b_transport(payload, delay);
            sc_core::wait(delay);
        }
        const tlm::tlm_response_status status = payload.get_response_status();
        payload.release();
        return status;
    }
    unsigned int debug(tlm::tlm_command command, std::uint64_t address,
                       std::vector<unsigned char>& data) {
        tlm::tlm_generic_payload payload;
        payload.set_command(command);
        payload.set_address(address);
        payload.set_data_ptr(data.data());
        payload.set_data_length(static_cast<unsigned int>(data.size()));
        return out->transport_dbg(payload);
    }

private:
    tlm::tlm_sync_enum backward(tlm::tlm_generic_payload& /*payload*/, tlm::tlm_phase& phase,
                                sc_core::sc_time& delay) {
        if (phase == tlm::BEGIN_RESP) {
            answered_.notify(delay);
            return tlm::TLM_COMPLETED;
        }
        return tlm::TLM_ACCEPTED;
    }
    void free(tlm::tlm_generic_payload* payload) override { delete payload; }
    sc_core::sc_event answered_;
};

/// A memory of two initiators, and one that calls each of them; a script that runs in a thread.
struct FaceBench {
    Lpddr5 memory{"memory", "", 2};
    Caller first{"first"}, second{"second"};
    FaceBench() {
        first.out.bind(memory.in(0));
        second.out.bind(memory.in(1));
    }
    void run(const std::function<void()>& body) {
        bool ended = false;
        const Script script("script", [&] {
            body();
            ended = true;
        });
        sc_core::sc_start();
        EXPECT_TRUE(ended);
    }
};

std::vector<unsigned char> random_bytes(std::mt19937& random, std::size_t count) {
    std::vector<unsigned char> bytes(count);
    for (unsigned char& byte : bytes) {
        byte = static_cast<unsigned char>(random());
    }
    return bytes;
}

class SmallRunLpddr5Enables : public ::testing::TestWithParam<bool> {}; // true: four phases

// Arrays shorter and longer than the data, as TLM repeats them; against a plain array.
TEST_P(SmallRunLpddr5Enables, MoveTheEnabledBytesAndNoOthers) {
    constexpr std::size_t kBytes = 3 * 4096;
    FaceBench bench;
    std::vector<unsigned char> shadow(kBytes, 0);
    bench.run([&] {
        std::mt19937 random(11);
        for (int i = 0; i < 400; ++i) {
            std::vector<unsigned char> data = random_bytes(random, 1 + random() % 300);
            std::vector<unsigned char> enables(random() % 2 == 0 ? 1 + random() % 9
                                                                 : 1 + random() % 400);
            for (unsigned char& enable : enables) {
                enable = random() % 3 == 0 ? TLM_BYTE_DISABLED : TLM_BYTE_ENABLED;
            }
            const std::uint64_t address = random() % (kBytes - data.size());
            const bool write = random() % 2 == 0;
            std::vector<unsigned char> expected = data;
            for (std::size_t at = 0; at < data.size(); ++at) {
                if (enables[at % enables.size()] == TLM_BYTE_ENABLED) {
                    (write ? shadow[address + at] : expected[at]) =
                        write ? data[at] : shadow[address + at];
                }
            }
            const auto command = write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND;
            ASSERT_EQ(bench.first.access(GetParam(), command, address, data, enables),
                      tlm::TLM_OK_RESPONSE);
            ASSERT_EQ(data, expected) << i;
        }
        std::vector<unsigned char> all(kBytes);
        EXPECT_EQ(bench.second.debug(tlm::TLM_READ_COMMAND, 0, all), kBytes);
        EXPECT_EQ(all, shadow);
    });
}

// One byte of 256 is enabled: the dates and the bytes on the bus are those of all of them.
TEST_P(SmallRunLpddr5Enables, TakeTheTimeOfWholeBursts) {
    FaceBench some;
    Lpddr5 whole("whole", "", 1);
    Caller other("other");
    other.out.bind(whole.in(0));
    std::vector<sc_core::sc_time> dates[2];
    const auto traffic = [&](Caller& caller, std::vector<unsigned char> enables,
                             std::vector<sc_core::sc_time>& answered) {
        std::vector<unsigned char> data(256);
        for (int i = 0; i < 100; ++i) {
            const auto command = i % 4 == 3 ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND;
            caller.access(GetParam(), command, 1000 * i, data, enables);
            answered.push_back(sc_core::sc_time_stamp());
        }
    };
    const Script script("of_the_other", [&] { traffic(other, {}, dates[1]); });
    some.run([&] {
        std::vector<unsigned char> one(256, TLM_BYTE_DISABLED);
        one[77] = TLM_BYTE_ENABLED;
        traffic(some.first, one, dates[0]);
    });
    EXPECT_EQ(dates[0], dates[1]);
    const auto all = whole.statistics();
    ASSERT_GT(all.size(), 40U);
    for (const Lpddr5::Statistic& each : all) {
        EXPECT_EQ(some.memory.statistic(each.name), each.value) << each.name;
    }
    EXPECT_GE(some.memory.statistic("bytes_read", 0), 75 * 256);
}

INSTANTIATE_TEST_SUITE_P(Both, SmallRunLpddr5Enables, ::testing::Bool(),
                         [](const ::testing::TestParamInfo<bool>& which) {
                             return which.param ? "FourPhases" : "Blocking";
                         });

TEST(HostileLpddr5Face, DebugTransportMovesWhatLiesInside) {
    FaceBench bench;
    const std::uint64_t end = bench.memory.capacity();
    std::mt19937 random(12);
    bench.run([&] {
        const std::vector<unsigned char> given = random_bytes(random, 9000); // three pages
        std::vector<unsigned char> data = given;
        EXPECT_EQ(bench.first.debug(tlm::TLM_WRITE_COMMAND, end - 8888, data), 8888U);
        std::vector<unsigned char> none;
        std::vector<unsigned char> timed(8888);
        bench.second.access(false, tlm::TLM_READ_COMMAND, end - 8888, timed, none);
        EXPECT_TRUE(std::equal(timed.begin(), timed.end(), given.begin()));
        std::vector<unsigned char> read(64, 7);
        EXPECT_EQ(bench.second.debug(tlm::TLM_READ_COMMAND, end - 10, read), 10U);
        EXPECT_TRUE(std::equal(read.begin(), read.begin() + 10, given.begin() + 8878));
        EXPECT_EQ(read[10], 7);
        EXPECT_EQ(bench.second.debug(tlm::TLM_READ_COMMAND, end, read), 0U);
        EXPECT_EQ(bench.second.debug(tlm::TLM_WRITE_COMMAND, ~std::uint64_t{0}, read), 0U);
        EXPECT_EQ(bench.second.debug(tlm::TLM_IGNORE_COMMAND, 0, read), 0U);
        read.clear();
        EXPECT_EQ(bench.second.debug(tlm::TLM_READ_COMMAND, 0, read), 0U);
    });
}

// Against what the requests were and, for what only the model inside counts, its laws.
TEST(SmallRunLpddr5Statistics, CountWhatHasHappened) {
    FaceBench bench;
    bench.run([&] {
        std::vector<unsigned char> data(64);
        std::vector<unsigned char> none;
        for (int i = 0; i < 50; ++i) {
            bench.first.access(false, tlm::TLM_READ_COMMAND, 4096 * i, data, none);
            bench.second.access(true, i % 2 == 0 ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND,
                                4096 * i, data, none);
        }
        sc_core::wait(sc_core::sc_time(10, sc_core::SC_US));
    });
    Lpddr5& memory = bench.memory;
    EXPECT_EQ(memory.statistic("reads", 0), 50);
    EXPECT_EQ(memory.statistic("writes", 0), 0);
    EXPECT_EQ(memory.statistic("writes", 1), 25);
    EXPECT_EQ(memory.statistic("bytes_written", 1), 25 * 64);
    EXPECT_EQ(memory.statistic("latency_ns.samples", 1), 25);
    EXPECT_GT(memory.statistic("latency_ns.mean", 0), memory.statistic("latency_ns.p50", 0) / 2);
    for (const char* name : {"reads", "writes", "bytes_read", "bytes_written"}) {
        EXPECT_EQ(memory.statistic(name), memory.statistic(name, 0) + memory.statistic(name, 1));
    }
    EXPECT_EQ(memory.statistic("transfers.on_bus") + memory.statistic("transfers.queued") +
                  memory.statistic("transfers.merged") + memory.statistic("transfers.forwarded"),
              memory.statistic("bytes"));
    EXPECT_EQ(32 * (memory.statistic("commands.rd") + memory.statistic("commands.wr")),
              memory.statistic("transfers.on_bus"));
    EXPECT_EQ(memory.statistic("peak_gb_per_s"), memory.peak_gb_per_s());
    EXPECT_NEAR(memory.statistic("bandwidth_fraction") * memory.peak_gb_per_s(),
                memory.statistic("bytes") / memory.statistic("simulated_us") / 1000, 1e-9);
    EXPECT_NEAR(memory.statistic("energy.mean_power_w") * memory.statistic("simulated_us"),
                memory.statistic("energy.total_nj") / 1000, 1e-9);
    EXPECT_DOUBLE_EQ(memory.statistic("energy.activate_nj"), memory.statistic("commands.act1"));
    EXPECT_THAT([&] { memory.statistic("row_hit_rat"); },
                ThrowsMessage<InputError>(
                    "memory: there is no statistic 'row_hit_rat', did you mean 'row_hit_rate'?"));
    EXPECT_THAT([&] { memory.statistic("row_hit_rate", 1); },
                ThrowsMessage<InputError>(
                    HasSubstr("memory of initiator 1: there is no statistic 'row_hit_rate'")));
}

// Who asks in the middle of a run changes no date.
TEST(SmallRunLpddr5Statistics, CanBeAskedForAtAnyTime) {
    FaceBench bench;
    Lpddr5 quiet("quiet", "", 1);
    Caller other("other");
    other.out.bind(quiet.in(0));
    std::vector<sc_core::sc_time> asked;
    std::vector<sc_core::sc_time> left;
    const auto traffic = [](Caller& caller, std::vector<sc_core::sc_time>& dates) {
        std::mt19937 random(13);
        std::vector<unsigned char> data(512);
        std::vector<unsigned char> none;
        for (int i = 0; i < 200; ++i) {
            const auto command = random() % 3 == 0 ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND;
            caller.access(random() % 2 == 0, command, random() % 4096 * 64, data, none);
            dates.push_back(sc_core::sc_time_stamp());
        }
    };
    const Script asking("asking", [&] {
        double before = 0;
        for (int i = 0; i < 500; ++i) {
            sc_core::wait(sc_core::sc_time(37.3, sc_core::SC_NS));
            const double now = bench.memory.statistic("commands.rd");
            EXPECT_GE(now, before);
            before = now;
        }
        EXPECT_GT(before, 1000);
    });
    const Script second("second_script", [&] { traffic(other, left); });
    bench.run([&] { traffic(bench.first, asked); });
    EXPECT_EQ(asked, left);
}

} // namespace
} // namespace degs::test
