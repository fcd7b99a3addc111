// SPDX-License-Identifier: Apache-2.0
// The energy that registers of degs::Accelerator show, against that of runs without a platform, and
// against the leakage of the bill of materials.
#include <gmock/gmock.h>

#include "base/ratio.hpp"
#include "baselines/accelerators.hpp"
#include "modules/degs/config.hpp"
#include "modules/kit/accelerator/accelerator_energy.hpp"
#include "tests/platform/views_bench.hpp"

namespace degs::test {
namespace {

using sc_core::sc_time;

/// What a driver reads of the last frame.
struct SeenEnergy {
    double frame_nj = 0, idle_nj = 0;
    std::uint64_t cycles = 0;
};

SeenEnergy seen(Host& host) {
    return {real_of(host.read_pair(Register::FrameEnergy)),
            real_of(host.read_pair(Register::IdleEnergy)), host.read_pair(Register::Cycles)};
}

/// One view, two eyes, and a foveated view.
std::vector<std::vector<RequestedView>> frames_of_views() {
    const std::vector<Camera> eyes = eyes_of(test_camera(61, 47), 0.3);
    std::vector<std::vector<RequestedView>> frames{
        {{test_camera()}}, {{eyes[0]}, {eyes[1]}}, {{eyes[0], Foveation{{0.5, 0.5}, 10, 20}}}};
    for (std::vector<RequestedView>& views : frames) {
        place(views);
    }
    return frames;
}

class SmallRunFrameEnergy : public ::testing::TestWithParam<std::size_t> {
protected:
    GaussianCloud cloud = test_cloud();

    void start(Platform& p, const std::vector<RequestedView>& views) {
        const std::vector<unsigned char> table = table_of(views);
        std::copy(table.begin(), table.end(), p.memory->bytes.begin() + kTable);
        program_views(p.host, cloud, views.size());
        p.host.write(Register::IrqStatus, kIrqAborted);
        p.host.write(Register::IrqEnable, kIrqDone);
        p.host.write(Register::Control, kControlStart);
    }
    /// The energy of a frame, when its blocks rest, read as a driver does.
    SeenEnergy frame(Platform& p, const std::vector<RequestedView>& views) {
        start(p, views);
        EXPECT_TRUE(p.host.await_irq());
        const double early = seen(p.host).frame_nj; // what cancelled tiles still cost is missing
        sc_core::wait(sc_time(2, sc_core::SC_US));
        const SeenEnergy rested = seen(p.host);
        EXPECT_LE(early, rested.frame_nj);
        EXPECT_GT(early, 0.98 * rested.frame_nj);
        return rested;
    }
};

// Dynamic energy and leakage of a frame are those that a run reports for it alone, whatever came
// before: frames of other views, and one that was given up.
TEST_P(SmallRunFrameEnergy, IsThatOfARunOfTheFrame) {
    const AcceleratorKind& kind = accelerator_kinds()[GetParam()];
    const std::unique_ptr<AcceleratorConfig> config = kind.make();
    config->read_floats();
    const auto frames = frames_of_views();
    Platform p("p", *config, cloud);
    std::vector<std::unique_ptr<ClosedViews>> closed;
    for (const std::vector<RequestedView>& views : frames) {
        closed.push_back(std::make_unique<ClosedViews>(
            ("closed" + std::to_string(closed.size())).c_str(), *config, cloud, views));
    }
    std::vector<SeenEnergy> all, scaled;
    p.host.script = [&](Host& host) {
        for (const std::vector<RequestedView>& views : frames) {
            all.push_back(frame(p, views));
            start(p, views);
            sc_core::wait(sc_time(700, sc_core::SC_NS));
            host.write(Register::Control, kControlAbort);
            while ((host.read(Register::Status) & kStatusBusy) != 0) {
            }
            EXPECT_EQ(seen(host).frame_nj, 0);
            EXPECT_EQ(seen(host).idle_nj, 0);
        }
        p.accelerator.set_operating_point({sc_time(1, sc_core::SC_NS), 0.5, 3});
        for (const std::vector<RequestedView>& views : frames) {
            scaled.push_back(frame(p, views));
        }
    };
    sc_core::sc_start();
    ASSERT_TRUE(p.host.finished);
    for (std::size_t f = 0; f < frames.size(); ++f) {
        AcceleratorResult result = closed[f]->result();
        result.cycles = closed[f]->finished.back(); // some cycles behind the last pixel
        const cost::RunEnergy energy = energy_of(*config, result, 1);
        EXPECT_EQ(all[f].cycles, result.cycles);
        EXPECT_NEAR(all[f].frame_nj, energy.dynamic_nj() + energy.leakage_nj(), 0.501) << f;
        EXPECT_NEAR(scaled[f].frame_nj, 0.5 * energy.dynamic_nj() + 3 * energy.leakage_nj(), 0.501)
            << f;
        EXPECT_GT(energy.leakage_nj(), 5);
    }
}

INSTANTIATE_TEST_SUITE_P(All, SmallRunFrameEnergy,
                         ::testing::Range(std::size_t{0}, accelerator_kinds().size()),
                         [](const auto& kind) {
                             return std::string(accelerator_kinds()[kind.param].name) + "_family";
                         });

/// What leaks, by the bill of materials.
class SmallRunIdleEnergy : public ::testing::Test {
protected:
    GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();
    const double watts = DegsConfig().bill().leakage_w();

    static Accelerator::Options options() {
        Accelerator::Options options;
        options.set("power.gated_leakage", "0.25");
        options.set("power.wake_ns", "300");
        return options;
    }
    Platform p{"p", DegsConfig(), cloud,
               std::make_unique<PlainMemory>("memory", kMemoryBytes, Timing::Annotated), options()};

    double leaked(double ns) const { return watts * ns; }
    static double now() { return sc_core::sc_time_stamp().to_seconds() * 1e9; }
    static void wait_until(double ns) { sc_core::wait(sc_time(ns - now(), sc_core::SC_NS)); }
    struct Dates {
        double start = 0, end = 0; ///< ns; of the command, and of the interrupt
    };
    /// A frame that starts at a date.
    Dates frame_at(Host& host, double ns) {
        program(host, cloud, camera);
        host.write(Register::IrqEnable, kIrqDone);
        wait_until(ns);
        host.write(Register::Control, kControlStart);
        sc_core::wait(p.irq.posedge_event());
        const double end = now();
        host.write(Register::IrqStatus, kIrqDone);
        return {ns, end};
    }
    void run(const std::function<void(Host&)>& script) {
        p.host.script = script;
        sc_core::sc_start();
        EXPECT_TRUE(p.host.finished);
    }
};

TEST_F(SmallRunIdleEnergy, IsTheLeakageBetweenFrames) {
    run([&](Host& host) {
        const Dates first = frame_at(host, 1e6);
        EXPECT_NEAR(seen(host).idle_nj, leaked(1e6), 1);
        EXPECT_NEAR(first.end - first.start, real_of(seen(host).cycles), 0.01);
        const Dates second = frame_at(host, 3e6);
        EXPECT_NEAR(seen(host).idle_nj, leaked(3e6 - first.end), 1);
        p.accelerator.set_operating_point({sc_time(2, sc_core::SC_NS), 0, 4});
        const Dates third = frame_at(host, 5e6);
        EXPECT_NEAR(seen(host).idle_nj, leaked(4 * (5e6 - second.end)), 4 * leaked(500) + 1);
        EXPECT_NEAR(seen(host).frame_nj, leaked(4 * 2 * real_of(seen(host).cycles)), 1);
        EXPECT_NEAR(third.end - third.start, 2 * real_of(seen(host).cycles), 0.01);
    });
}

TEST_F(SmallRunIdleEnergy, IsAShareOfItWhereSoftwareGatesTheSupplyWhichThenWakes) {
    run([&](Host& host) {
        const Dates first = frame_at(host, 1e6);
        wait_until(2e6);
        host.write(Register::Power, ~0U);
        EXPECT_EQ(host.read(Register::Power), kPowerGateIdle);
        const Dates second = frame_at(host, 6e6);
        const std::uint64_t cycles = seen(host).cycles;
        EXPECT_NEAR(second.end - second.start, 300 + real_of(cycles), 0.01);
        EXPECT_NEAR(seen(host).idle_nj, leaked(2e6 - first.end) + 0.25 * leaked(4e6) + leaked(300),
                    1);
        const Dates third = frame_at(host, 8e6); // gated from the end of the frame on
        EXPECT_NEAR(third.end - third.start, 300 + real_of(cycles), 0.01);
        EXPECT_EQ(seen(host).cycles, cycles);
        EXPECT_NEAR(seen(host).idle_nj, 0.25 * leaked(8e6 - second.end) + leaked(300), 1);
        wait_until(9e6);
        host.write(Register::Control, kControlReset);
        while ((host.read(Register::Status) & kStatusInReset) != 0) {
        }
        EXPECT_EQ(host.read(Register::Power), 0U);
        EXPECT_EQ(seen(host).frame_nj, 0);
        const Dates last = frame_at(host, 1e7);
        EXPECT_NEAR(last.end - last.start, real_of(cycles), 0.01);
        EXPECT_NEAR(seen(host).idle_nj, leaked(1e6), 1);
    });
}

// A frame that is given up is part of the time before the next one.
TEST_F(SmallRunIdleEnergy, HasFramesThatWereGivenUp) {
    run([&](Host& host) {
        program(host, cloud, camera);
        host.write(Register::Power, kPowerGateIdle);
        wait_until(1e6);
        host.write(Register::Control, kControlStart);
        wait_until(1e6 + 100); // its supply wakes
        host.write(Register::Control, kControlAbort);
        while ((host.read(Register::Status) & kStatusBusy) != 0) {
        }
        EXPECT_EQ(p.memory->accesses, 0U);
        frame_at(host, 3e6);
        EXPECT_NEAR(seen(host).idle_nj, 0.25 * leaked(3e6) + leaked(300), leaked(200) + 1);
    });
}

} // namespace
} // namespace degs::test
