// SPDX-License-Identifier: Apache-2.0
// degs::Accelerator on a clock of the platform.
#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {
namespace {

using sc_core::sc_time;

struct ClockedFrame {
    std::uint64_t cycles = 0;
    sc_time end; ///< when the interrupt rises
    std::vector<unsigned char> pixels;
};

class SmallRunClock : public ::testing::Test {
protected:
    GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();

    /// Two frames; after each of them another one, with a reset in its middle.
    std::vector<ClockedFrame>& draw(Platform& p) {
        auto& frames = frames_.emplace_back();
        p.host.script = [&p, &frames, this](Host& host) {
            for (int i = 0; i < 2; ++i) {
                program(host, cloud, camera);
                host.write(Register::IrqEnable, kIrqDone);
                host.write(Register::Control, kControlStart);
                sc_core::wait(p.irq.posedge_event());
                const sc_time end = sc_core::sc_time_stamp();
                frames.push_back({host.read_pair(Register::Cycles), end, p.frame(camera)});
                host.write(Register::IrqStatus, kIrqDone);
                host.write(Register::Control, kControlStart);
                sc_core::wait(sc_time(777.7, sc_core::SC_NS));
                host.write(Register::Control, kControlReset);
                sc_core::wait(sc_time(1, sc_core::SC_US));
            }
        };
        return frames;
    }
    static sc_time after_edge(const sc_time& time, const sc_time& edge, const sc_time& period) {
        return sc_time::from_value((time - edge).value() % period.value());
    }

private:
    std::deque<std::vector<ClockedFrame>> frames_;
};

TEST_F(SmallRunClock, TakesItsPeriodAndItsEdges) {
    DegsConfig half;
    half.clock_ghz = 0.5;
    Platform free_running("free_running", half, cloud);
    Platform rising("rising", DegsConfig(), cloud);
    Platform falling("falling", DegsConfig(), cloud);
    const sc_time period(2, sc_core::SC_NS);
    const sc_time start(300, sc_core::SC_PS);
    sc_core::sc_clock rising_clock("rising_clock", period, 0.5, start);
    sc_core::sc_clock falling_clock("falling_clock", period, 0.25, start, false);
    rising.accelerator.clk.bind(rising_clock);
    falling.accelerator.clk.bind(falling_clock);
    const auto& plain = draw(free_running);
    const auto& first = draw(rising);
    const auto& second = draw(falling);
    sc_core::sc_start(sc_time(1, sc_core::SC_MS)); // a clock never ends
    ASSERT_TRUE(free_running.host.finished && rising.host.finished && falling.host.finished);
    EXPECT_DOUBLE_EQ(rising.accelerator.clock_ghz(), 0.5);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(plain[i].cycles, plain[0].cycles);
        EXPECT_EQ(first[i].cycles, plain[0].cycles);
        EXPECT_EQ(second[i].cycles, plain[0].cycles);
        EXPECT_EQ(first[i].pixels, plain[0].pixels);
        EXPECT_EQ(second[i].pixels, plain[0].pixels);
        EXPECT_EQ(after_edge(plain[i].end, sc_core::SC_ZERO_TIME, period), sc_core::SC_ZERO_TIME);
        EXPECT_EQ(after_edge(first[i].end, start, period), sc_core::SC_ZERO_TIME);
        EXPECT_EQ(after_edge(second[i].end, start + period * 0.75, period), sc_core::SC_ZERO_TIME);
    }
}

TEST_F(SmallRunClock, TheClockOfTheConfigurationDoesNotMatterThen) {
    DegsConfig fast;
    fast.clock_ghz = 4;
    Platform a("a", DegsConfig(), cloud);
    Platform b("b", fast, cloud);
    sc_core::sc_clock clock("clock", 1.5, sc_core::SC_NS);
    a.accelerator.clk.bind(clock);
    b.accelerator.clk.bind(clock);
    const auto& first = draw(a);
    const auto& second = draw(b);
    sc_core::sc_start(sc_time(1, sc_core::SC_MS));
    ASSERT_TRUE(a.host.finished && b.host.finished);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(first[i].cycles, second[i].cycles);
        EXPECT_EQ(first[i].end, second[i].end);
    }
}

} // namespace
} // namespace degs::test
