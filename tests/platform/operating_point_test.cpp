// SPDX-License-Identifier: Apache-2.0
// A platform that changes the clock of an accelerator between frames.
#include <cmath>
#include <limits>
#include <tuple>

#include <gmock/gmock.h>

#include "base/ratio.hpp"
#include "baselines/accelerators.hpp"
#include "degs/lpddr5.hpp"
#include "degs/messages.hpp"
#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {
namespace {

using sc_core::sc_time;

OperatingPoint point_of(double ns) {
    return {sc_time(ns, sc_core::SC_NS)};
}

void await_end(Host& host) {
    while ((host.read(Register::Status) & (kStatusBusy | kStatusInReset)) != 0) {
        sc_core::wait(sc_time(10, sc_core::SC_NS));
    }
    host.write(Register::IrqStatus, kIrqDone | kIrqAborted);
}

/// A platform whose memory has banks and rows.
struct DramPlatform : Platform {
    DramPlatform(const std::string& name, const AcceleratorConfig& config,
                 const GaussianCloud& cloud)
        : Platform(name.c_str(), config, cloud, nullptr), dram((name + "_dram").c_str(), "", 1) {
        mem().bind(dram.in(0));
    }
    Lpddr5 dram;

    /// When the simulation runs.
    void put_scene(const GaussianCloud& cloud) {
        std::vector<unsigned char> geometry;
        std::vector<unsigned char> sh;
        encode_scene(cloud, geometry, sh);
        put(0, geometry);
        put(kSh, sh);
    }

private:
    void put(std::uint64_t address, std::vector<unsigned char>& bytes) {
        tlm::tlm_generic_payload payload;
        payload.set_write();
        payload.set_address(address);
        payload.set_data_ptr(bytes.data());
        payload.set_data_length(static_cast<unsigned>(bytes.size()));
        EXPECT_EQ(mem()->transport_dbg(payload), bytes.size());
    }
};

class SmallRunOperatingPoint : public ::testing::TestWithParam<std::size_t> {
protected:
    GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();

    std::unique_ptr<AcceleratorConfig> config(double ns = 1) const {
        std::unique_ptr<AcceleratorConfig> made = accelerator_kinds()[GetParam()].make();
        made->clock_ghz = 1 / ns;
        return made;
    }
    /// The cycles of a frame that starts at a date.
    std::uint64_t frame_at(Host& host, const sc_time& date) {
        program(host, cloud, camera);
        EXPECT_LT(sc_core::sc_time_stamp(), date);
        sc_core::wait(date - sc_core::sc_time_stamp());
        EXPECT_TRUE(host.render());
        return host.read_pair(Register::Cycles);
    }
    /// Frames at other points, some given up, with changes while they are rendered.
    void trouble(Host& host, Accelerator& accelerator) {
        for (const std::uint32_t end : {0U, kControlAbort, kControlReset, 0U}) {
            const sc_time before = accelerator.operating_point().period;
            program(host, cloud, camera);
            host.write(Register::Control, kControlStart);
            sc_core::wait(sc_time(700, sc_core::SC_NS));
            accelerator.set_operating_point(point_of(3.1));
            accelerator.set_operating_point(
                point_of(before == sc_time(1.7, sc_core::SC_NS) ? 0.6 : 1.7));
            EXPECT_EQ(host.read(Register::Status), kStatusBusy);
            EXPECT_EQ(accelerator.operating_point().period, before);
            if (end != 0) {
                host.write(Register::Control, end);
            }
            await_end(host);
            sc_core::wait(sc_time(50, sc_core::SC_NS));
            EXPECT_NE(accelerator.operating_point().period, before);
        }
    }
};

// The clock goes on without the memory, whose transactions take no time.
TEST_P(SmallRunOperatingPoint, TakesNoCyclesWithoutTheTimeOfAMemory) {
    Platform p("p", *config(), cloud, Timing::Immediate);
    std::vector<std::uint64_t> cycles;
    std::vector<sc_time> took;
    const std::vector<double> periods{1, 0.25, 1.701, 8, 1};
    p.host.script = [&](Host& host) {
        for (const double ns : periods) {
            p.accelerator.set_operating_point(point_of(ns));
            program(host, cloud, camera);
            host.write(Register::IrqEnable, kIrqDone);
            const sc_time start = sc_core::sc_time_stamp();
            host.write(Register::Control, kControlStart);
            sc_core::wait(p.irq.posedge_event());
            took.push_back(sc_core::sc_time_stamp() - start);
            cycles.push_back(host.read_pair(Register::Cycles));
            host.write(Register::IrqStatus, kIrqDone);
            EXPECT_NEAR(p.accelerator.clock_ghz() * ns, 1, 1e-9);
        }
    };
    sc_core::sc_start();
    ASSERT_TRUE(p.host.finished);
    EXPECT_THAT(cycles, ::testing::Each(cycles.front()));
    for (std::size_t f = 0; f < periods.size(); ++f) {
        const double waited = took[f].to_seconds() * 1e9 / periods[f] - real_of(cycles[f]);
        EXPECT_GE(waited, -1e-6) << f; // for an edge
        EXPECT_LT(waited, 1.001) << f;
    }
}

// Whatever came before, a frame is that of an accelerator which has had its period from the start,
// on a memory with banks and rows.
TEST_P(SmallRunOperatingPoint, MakesTheAcceleratorOneOfThatPeriod) {
    const std::vector<double> periods{1.25, 0.5, 2};
    DramPlatform p("p", *config(0.8), cloud);
    std::vector<std::unique_ptr<DramPlatform>> fresh;
    std::vector<std::uint64_t> expected(periods.size()), cycles;
    const auto date_of = [](std::size_t i) {
        return sc_time(200 * real_of(i + 1), sc_core::SC_US);
    };
    for (std::size_t i = 0; i < periods.size(); ++i) {
        fresh.push_back(std::make_unique<DramPlatform>("fresh" + std::to_string(i),
                                                       *config(periods[i]), cloud));
        fresh.back()->host.script = [&, i](Host& host) {
            fresh[i]->put_scene(cloud);
            expected[i] = frame_at(host, date_of(i));
        };
    }
    p.host.script = [&](Host& host) {
        p.put_scene(cloud);
        for (std::size_t i = 0; i < periods.size(); ++i) {
            trouble(host, p.accelerator);
            p.accelerator.set_operating_point(point_of(periods[i]));
            cycles.push_back(frame_at(host, date_of(i)));
        }
    };
    sc_core::sc_start(sc_time(1, sc_core::SC_MS));
    ASSERT_TRUE(p.host.finished);
    EXPECT_EQ(cycles, expected);
    EXPECT_NE(expected[0], expected[1]);
}

INSTANTIATE_TEST_SUITE_P(All, SmallRunOperatingPoint,
                         ::testing::Range(std::size_t{0}, accelerator_kinds().size()),
                         [](const auto& kind) {
                             return std::string(accelerator_kinds()[kind.param].name) + "_family";
                         });

class SmallRunPointFace : public ::testing::Test {
protected:
    GaussianCloud cloud = test_cloud();
    Platform p{"p", DegsConfig(), cloud};

    /// Why a point is refused; empty if it is not.
    std::string refusal(const OperatingPoint& point) {
        try {
            p.accelerator.set_operating_point(point);
        } catch (const sc_core::sc_report& report) {
            EXPECT_STREQ(report.get_msg_type(), reports::kPower);
            EXPECT_THAT(report.get_msg(), ::testing::StartsWith("p: "));
            return report.get_msg();
        }
        return "";
    }
};

TEST_F(SmallRunPointFace, RefusesWhatCannotBeAndChangesNothing) {
    using ::testing::HasSubstr;
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    p.host.script = [&](Host&) {
        const sc_time ps(1, sc_core::SC_PS), ns(1, sc_core::SC_NS);
        EXPECT_THAT(refusal({sc_core::SC_ZERO_TIME}), HasSubstr("0 s has no two halves"));
        EXPECT_THAT(refusal({ps}), HasSubstr("1 ps has no two halves"));
        EXPECT_THAT(refusal({ns, -0.5}), HasSubstr("finite and not negative"));
        EXPECT_THAT(refusal({ns, 1, kNone}), HasSubstr("finite and not negative"));
        EXPECT_EQ(p.accelerator.operating_point().period, ns);
        EXPECT_EQ(refusal({2 * ps, 0, 0}), "");
        sc_core::wait(ns);
        EXPECT_EQ(p.accelerator.operating_point().period, 2 * ps);
    };
    sc_core::sc_start();
    EXPECT_TRUE(p.host.finished);
}

TEST_F(SmallRunPointFace, IsThatOfTheStartIfItIsSetBeforeAndOfTheNextWhileItPauses) {
    p.accelerator.set_operating_point(point_of(4));
    sc_time took;
    p.host.script = [&](Host& host) {
        EXPECT_EQ(p.accelerator.clock_ghz(), 0.25);
        const sc_time begin = sc_core::sc_time_stamp();
        host.read(Register::Id);
        took = sc_core::sc_time_stamp() - begin;
    };
    sc_core::sc_start();
    ASSERT_TRUE(p.host.finished);
    EXPECT_EQ(took, sc_time(4, sc_core::SC_NS));
    p.accelerator.set_operating_point(point_of(2));
    sc_core::sc_start(sc_time(1, sc_core::SC_NS));
    EXPECT_EQ(p.accelerator.clock_ghz(), 0.5);
}

TEST_F(SmallRunPointFace, OfAClockOfThePlatformHasItsPeriod) {
    sc_core::sc_clock clock("clock", 1.5, sc_core::SC_NS);
    p.accelerator.clk.bind(clock);
    p.host.script = [&](Host&) {
        EXPECT_THAT(refusal(point_of(2)), ::testing::HasSubstr("whose period cannot become 2 ns"));
        EXPECT_EQ(refusal({sc_time(1.5, sc_core::SC_NS), 0.5, 0.25}), "");
        sc_core::wait(sc_time(1, sc_core::SC_NS));
        EXPECT_EQ(p.accelerator.operating_point().energy_factor, 0.5);
        EXPECT_EQ(p.accelerator.operating_point().period, sc_time(1.5, sc_core::SC_NS));
    };
    sc_core::sc_start(sc_time(1, sc_core::SC_US));
    EXPECT_TRUE(p.host.finished);
}

} // namespace
} // namespace degs::test
