// SPDX-License-Identifier: Apache-2.0
// Reset and abort of degs::Accelerator in the middle of a frame.
#include <tuple>

#include "baselines/accelerators.hpp"
#include "config/config_source.hpp"
#include "modules/degs/config.hpp"
#include "tests/platform/reset_platform.hpp"

namespace degs::test {
namespace {

/// How a frame is given up.
enum class Way { Line, Register, Abort };

/// The first frame after power-on, and frames after others that were given up.
class ResetBench {
public:
    ResetBench(const AcceleratorConfig& config, Bus bus, Fidelity fidelity, int resets)
        : fresh_("fresh", config, cloud_, bus, options_of(bus, fidelity)),
          p_("p", config, cloud_, bus, options_of(bus, fidelity)) {
        fresh_.host.script = [this](Host& host) {
            good_ = frame(host, fresh_);
            done_.notify(sc_core::SC_ZERO_TIME);
        };
        p_.host.script = [this, resets](Host& host) {
            sc_core::wait(done_);
            for (int i = 0; i < resets && !::testing::Test::HasFailure(); ++i) {
                SCOPED_TRACE(i);
                give_up(host, static_cast<Way>(i % 3));
                const Frame next = frame(host, p_);
                EXPECT_EQ(next.cycles, good_.cycles);
                EXPECT_EQ(next.pixels, good_.pixels);
            }
        };
        sc_core::sc_start();
        EXPECT_TRUE(fresh_.host.finished && p_.host.finished);
    }
    /// Pixels that frames had written, and had still to write, when they were given up.
    std::uint64_t written = 0, missing = 0;
    sc_core::sc_time longest; ///< from the request to the end of a stop
    std::uint64_t cycles() const { return good_.cycles; }

private:
    struct Frame {
        std::uint64_t cycles = 0;
        std::vector<unsigned char> pixels;
    };
    Frame frame(Host& host, ResetPlatform& p) {
        p.erase(camera_);
        program(host, cloud_, camera_);
        EXPECT_TRUE(host.render());
        EXPECT_EQ(host.read(Register::Status), kStatusDone);
        return {host.read_pair(Register::Cycles), p.pixels(camera_)};
    }
    /// Starts a frame and gives it up at a random date of it.
    void give_up(Host& host, Way way) {
        p_.erase(camera_);
        program(host, cloud_, camera_);
        host.write(Register::IrqEnable, 0);
        host.write(Register::Control, kControlStart);
        const std::uint64_t longest_wait = good_.cycles * 1000;
        sc_core::wait(sc_core::sc_time::from_value(random_() % longest_wait));
        EXPECT_EQ(host.read(Register::Status), kStatusBusy);
        stop(host, way);
        const std::uint64_t accesses = p_.accesses();
        const std::vector<unsigned char> memory = p_.bytes();
        EXPECT_TRUE(p_.at == nullptr || p_.at->under_way == 0);
        sc_core::wait(sc_core::sc_time(20, sc_core::SC_US));
        EXPECT_EQ(p_.accesses(), accesses);
        EXPECT_EQ(p_.bytes(), memory);
        count_pixels();
    }
    void stop(Host& host, Way way) {
        const sc_core::sc_time begin = sc_core::sc_time_stamp();
        if (way == Way::Line) {
            p_.reset_n.write(false);
            sc_core::wait(sc_core::sc_time(3, sc_core::SC_NS));
            EXPECT_EQ(host.read(Register::Status), kStatusInReset);
            host.write(Register::Width, 5); // is ignored
            p_.reset_n.write(true);
        } else {
            host.write(Register::Control, way == Way::Abort ? kControlAbort : kControlReset);
        }
        while ((host.read(Register::Status) & (kStatusInReset | kStatusBusy)) != 0) {
            sc_core::wait(sc_core::sc_time(1, sc_core::SC_NS));
        }
        longest = std::max(longest, sc_core::sc_time_stamp() - begin);
        if (way == Way::Abort) {
            EXPECT_EQ(host.read(Register::Status), kStatusAborted);
            EXPECT_EQ(host.read(Register::IrqStatus), kIrqAborted);
            EXPECT_EQ(host.read(Register::Width), static_cast<std::uint32_t>(camera_.width));
            host.write(Register::IrqStatus, kIrqAborted);
        } else {
            const AcceleratorRegisters power_on;
            for (std::uint32_t word = 0; word < kRegisterBytes; word += 4) {
                std::uint32_t value = 0;
                host.access(tlm::TLM_READ_COMMAND, word, &value, 4);
                EXPECT_EQ(value, power_on.word(word)) << word;
            }
        }
        EXPECT_EQ(host.error(), AcceleratorError::None);
    }
    /// Every pixel is that of the good frame, or has not been written.
    void count_pixels() {
        const std::vector<unsigned char> now = p_.pixels(camera_);
        for (std::size_t at = 0; at < now.size(); at += 4) {
            const bool good = std::equal(&now[at], &now[at] + 4, &good_.pixels[at]);
            const bool erased = std::all_of(&now[at], &now[at] + 4, [](unsigned char byte) {
                return byte == ResetPlatform::kErased;
            });
            ASSERT_TRUE(good || erased) << "pixel " << at / 4 << " is torn";
            (good ? written : missing) += 1;
        }
    }

    GaussianCloud cloud_ = test_cloud();
    Camera camera_ = test_camera();
    std::mt19937 random_{7};
    sc_core::sc_event done_;
    Frame good_;
    ResetPlatform fresh_, p_;
};

using Design = std::tuple<std::size_t, Bus, Fidelity>; // by number among accelerator_kinds()

std::string design_name(const ::testing::TestParamInfo<Design>& design) {
    constexpr const char* kBuses[] = {"Annotated", "Blocking", "FourPhases", "Quantum"};
    const bool strict = std::get<2>(design.param) == Fidelity::Strict;
    return accelerator_kinds()[std::get<0>(design.param)].name +
           std::string(kBuses[static_cast<std::size_t>(std::get<1>(design.param))]) +
           (strict ? "Strict" : "Exact");
}

class SmallRunReset : public ::testing::TestWithParam<Design> {};

TEST_P(SmallRunReset, FramesAfterItAreThoseAfterPowerOn) {
    const auto& [kind, bus, fidelity] = GetParam();
    const sc_core::sc_time quantum(bus == Bus::Quantum ? 100 : 0, sc_core::SC_NS);
    tlm::tlm_global_quantum::instance().set(quantum);
    const ResetBench bench(*accelerator_kinds()[kind].make(), bus, fidelity, 18);
    EXPECT_GT(bench.written, 0U);
    EXPECT_GT(bench.missing, bench.written / 10);
    // An access that is on the bus, up to a quantum ahead, takes 50 ns, and what is left of the
    // frame 2 ps per cycle.
    EXPECT_LT(bench.longest, quantum + sc_core::sc_time(60, sc_core::SC_NS) +
                                 sc_core::sc_time::from_value(4 * bench.cycles()));
    RecordProperty("cycles", std::to_string(bench.cycles()));
    RecordProperty("longest_stop", bench.longest.to_string());
}

INSTANTIATE_TEST_SUITE_P(All, SmallRunReset,
                         ::testing::Combine(::testing::Range(std::size_t{0},
                                                             accelerator_kinds().size()),
                                            ::testing::Values(Bus::Annotated, Bus::Blocking,
                                                              Bus::FourPhases, Bus::Quantum),
                                            ::testing::Values(Fidelity::Exact)),
                         design_name);
INSTANTIATE_TEST_SUITE_P(
    Strict, SmallRunReset,
    ::testing::Combine(::testing::Range(std::size_t{0}, accelerator_kinds().size()),
                       ::testing::Values(Bus::FourPhases), ::testing::Values(Fidelity::Strict)),
    design_name);

// What runs through several frames in hardware, such as whose turn it is among tile streams.
TEST(SmallRunResetOfADesign, StreamsAndEnginesBeginAnew) {
    DegsConfig config;
    std::string kind;
    ConfigSource::from_file(std::string(DEGS_CONFIGS) + "/degs-1024-streams.yaml")
        .read([&](ConfigVisitor& visitor) {
            visitor.text("accelerator", kind, "which one the file is for");
            config.describe(visitor);
        });
    ASSERT_GT(config.streams(), 1);
    const ResetBench bench(config, Bus::FourPhases, Fidelity::Exact, 12);
    EXPECT_GT(bench.missing, 0U);
}

/// One platform and a script.
class SmallRunResetFace : public ::testing::Test {
protected:
    GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();
    ResetPlatform p{"p", DegsConfig(), cloud, Bus::Annotated, {}};

    void run(const std::function<void(Host&)>& script) {
        p.host.script = script;
        sc_core::sc_start();
        EXPECT_TRUE(p.host.finished);
    }
    static void await_end(Host& host) {
        while ((host.read(Register::Status) & (kStatusInReset | kStatusBusy)) != 0) {
            sc_core::wait(sc_core::sc_time(1, sc_core::SC_NS));
        }
    }
};

TEST_F(SmallRunResetFace, AStartInResetIsIgnoredAndFlagged) {
    run([&](Host& host) {
        program(host, cloud, camera);
        host.write(Register::Control, kControlStart);
        sc_core::wait(sc_core::sc_time(200, sc_core::SC_NS));
        host.write(Register::Control, kControlReset | kControlStart);
        host.write(Register::Control, kControlStart); // a cycle later, in reset
        await_end(host);
        EXPECT_EQ(host.read(Register::Status), kStatusStartIgnored);
        const std::uint64_t accesses = p.accesses();
        sc_core::wait(sc_core::sc_time(20, sc_core::SC_US));
        EXPECT_EQ(p.accesses(), accesses);
        program(host, cloud, camera);
        EXPECT_TRUE(host.render());
    });
}

TEST_F(SmallRunResetFace, TheLineHoldsTheAcceleratorFromPowerOnOnAndAsLongAsItIsLow) {
    p.reset_n.write(false);
    run([&](Host& host) {
        sc_core::wait(sc_core::sc_time(30, sc_core::SC_US));
        EXPECT_EQ(host.read(Register::Status), kStatusInReset);
        host.write(Register::Width, 7);
        host.write(Register::Control, kControlStart);
        EXPECT_EQ(host.read(Register::Width), 0U);
        EXPECT_EQ(host.read(Register::Status), kStatusInReset);
        p.reset_n.write(true);
        await_end(host);
        EXPECT_EQ(host.read(Register::Status), 0U);
        EXPECT_EQ(p.accesses(), 0U);
        program(host, cloud, camera);
        EXPECT_TRUE(host.render());
    });
}

TEST_F(SmallRunResetFace, ALineThatStaysLowLetsTheSimulationEnd) {
    p.reset_n.write(false);
    run([](Host& host) {
        sc_core::wait(sc_core::sc_time(1, sc_core::SC_US));
        host.read(Register::Id);
    });
    EXPECT_LT(sc_core::sc_time_stamp(), sc_core::sc_time(2, sc_core::SC_US));
}

TEST_F(SmallRunResetFace, AResetMayFollowAnAbortAndAnotherReset) {
    run([&](Host& host) {
        for (const std::uint32_t first : {kControlAbort, kControlReset}) {
            program(host, cloud, camera);
            host.write(Register::Control, kControlStart);
            sc_core::wait(sc_core::sc_time(300, sc_core::SC_NS));
            host.write(Register::Control, first);
            p.reset_n.write(false);
            sc_core::wait(sc_core::sc_time(7, sc_core::SC_NS));
            p.reset_n.write(true);
            await_end(host);
            EXPECT_EQ(host.read(Register::Status), 0U); // no abort
            EXPECT_EQ(host.read(Register::IrqStatus), 0U);
            program(host, cloud, camera);
            EXPECT_TRUE(host.render());
        }
    });
}

TEST_F(SmallRunResetFace, AnAbortWithoutAFrameDoesNothingAndThatOfOneRaisesItsInterrupt) {
    run([&](Host& host) {
        host.write(Register::Control, kControlAbort);
        EXPECT_EQ(host.read(Register::Status), 0U);
        program(host, cloud, camera);
        host.write(Register::IrqEnable, kIrqAborted);
        host.write(Register::Control, kControlStart);
        host.write(Register::Control, kControlAbort); // before the scene is there
        EXPECT_FALSE(host.await_irq());
        EXPECT_EQ(host.read(Register::Status), kStatusAborted);
        EXPECT_EQ(host.read(Register::Frames), 0U);
        host.write(Register::Control, kControlClearError);
        EXPECT_EQ(host.read(Register::Status), 0U);
        EXPECT_TRUE(host.render());
        EXPECT_EQ(host.read(Register::Frames), 1U);
    });
}

// An interrupt that nobody has seen yet stays beside that of the abort, and the next start clears
// the flag.
TEST_F(SmallRunResetFace, AnAbortKeepsOtherInterrupts) {
    run([&](Host& host) {
        const auto start_and = [&](std::uint32_t command) {
            host.write(Register::Control, kControlStart);
            host.write(Register::Control, command);
            await_end(host);
        };
        program(host, cloud, camera);
        start_and(0);
        EXPECT_EQ(host.read(Register::IrqStatus), kIrqDone);
        start_and(kControlAbort);
        EXPECT_EQ(host.read(Register::Status), kStatusAborted);
        EXPECT_EQ(host.read(Register::IrqStatus), kIrqDone | kIrqAborted);
        host.write(Register::IrqStatus, kIrqDone | kIrqAborted);
        EXPECT_TRUE(host.render());
        EXPECT_EQ(host.read(Register::Status), kStatusDone);
    });
}

// A host that is ahead of time aborts in 100 ns and resets in 400: the frame ends with the first.
TEST_F(SmallRunResetFace, TheFirstOfTwoStopsHasTheDate) {
    run([&](Host& host) {
        program(host, cloud, camera);
        host.write(Register::Control, kControlStart);
        sc_core::wait(sc_core::sc_time(300, sc_core::SC_NS));
        host.decoupled = true;
        host.ahead = sc_core::sc_time(100, sc_core::SC_NS);
        host.write(Register::Control, kControlAbort);
        host.ahead = sc_core::sc_time(400, sc_core::SC_NS);
        host.write(Register::Control, kControlReset);
        host.decoupled = false;
        host.ahead = sc_core::SC_ZERO_TIME;
        EXPECT_EQ(host.read(Register::Status), kStatusInReset);
        sc_core::wait(sc_core::sc_time(200, sc_core::SC_NS));
        EXPECT_EQ(host.read(Register::Status), 0U);
    });
}

// The scene is read by transactions, of which one is on the bus.
TEST(SmallRunResetWhileLoading, ReadsNoMoreAndDrawsNothing) {
    const GaussianCloud cloud = test_cloud();
    Platform p("p", DegsConfig(), cloud, Timing::Blocking, false);
    p.host.script = [&](Host& host) {
        program(host, cloud, test_camera());
        host.write(Register::Control, kControlStart);
        sc_core::wait(sc_core::sc_time(60, sc_core::SC_NS)); // of 200
        host.write(Register::Control, kControlAbort);
        host.write(Register::IrqEnable, kIrqAborted);
        EXPECT_FALSE(host.await_irq());
        EXPECT_EQ(p.memory->accesses, 2U);
        program(host, cloud, test_camera());
        EXPECT_TRUE(host.render());
        EXPECT_EQ(host.read_pair(Register::LoadCycles), 200U);
    };
    sc_core::sc_start();
    EXPECT_TRUE(p.host.finished);
}

} // namespace
} // namespace degs::test
