// SPDX-License-Identifier: Apache-2.0
// degs::Lpddr5 as programs outside see it: the resolution of time, and numbers of initiators.
#include <stdexcept>

#include <gmock/gmock.h>
#include <tlm_utils/simple_initiator_socket.h>

#include "degs/error.hpp"
#include "degs/lpddr5.hpp"
#include "tests/platform/accelerator_bench.hpp"

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
    EXPECT_EQ(memory.bytes_read(1), 0U);
    const auto refused =
        ThrowsMessage<std::out_of_range>(HasSubstr("memory: there is no initiator 9"));
    EXPECT_THAT([&] { memory.bytes_read(9); }, refused);
    EXPECT_THAT([&] { memory.bytes_written(9); }, refused);
    EXPECT_THAT([&] { memory.in(9); }, refused);
}

} // namespace
} // namespace degs::test
