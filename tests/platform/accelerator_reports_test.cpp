// SPDX-License-Identifier: Apache-2.0
// What degs::Accelerator reports before the simulation starts: one test per message type and cause.
#include "degs/messages.hpp"

#include <gmock/gmock.h>

#include "config/config_source.hpp"
#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {
namespace {

using ::testing::HasSubstr;

struct Reported {
    std::string type, text;
    sc_core::sc_severity severity = sc_core::SC_INFO;
};

class SmallRunReports : public ::testing::Test {
protected:
    SmallRunReports() {
        reported_.clear();
        sc_core::sc_report_handler::set_handler([](const sc_core::sc_report& report,
                                                   const sc_core::sc_actions& actions) {
            reported_.push_back({report.get_msg_type(), report.get_msg(), report.get_severity()});
            sc_core::sc_report_handler::default_handler(report, actions & ~sc_core::SC_DISPLAY);
        });
    }
    ~SmallRunReports() override { sc_core::sc_report_handler::set_handler(nullptr); }

    /// Builds an accelerator and returns the error that this throws.
    static Reported refusal(const AcceleratorConfig& config,
                            const Accelerator::Options& options = {}) {
        try {
            const Accelerator accelerator("refused", config, options);
        } catch (const sc_core::sc_report& report) {
            EXPECT_EQ(reported_.size(), 1U);
            EXPECT_EQ(reported_.back().type, report.get_msg_type());
            EXPECT_EQ(reported_.back().severity, sc_core::SC_ERROR);
            return reported_.back();
        }
        ADD_FAILURE() << "nothing was refused";
        return {};
    }
    static const std::vector<Reported>& reported() { return reported_; }

private:
    inline static std::vector<Reported> reported_;
};

TEST_F(SmallRunReports, AConfigurationWithAProblem) {
    DegsConfig config;
    config.scheduler.banks = 0;
    const Reported report = refusal(config);
    EXPECT_EQ(report.type, "/DeGS/accelerator/config");
    EXPECT_THAT(report.text, HasSubstr("refused: configuration"));
    EXPECT_THAT(report.text, HasSubstr("scheduler.banks"));
}

/// Options that leave an accelerator nothing to do, or that no memory can serve.
struct WrongOptions {
    const char* name;
    void (*change)(Accelerator::Options& options);
    const char* text;
};

void PrintTo(const WrongOptions& wrong, std::ostream* out) {
    *out << wrong.name;
}

class SmallRunOptions : public SmallRunReports,
                        public ::testing::WithParamInterface<WrongOptions> {};

TEST_P(SmallRunOptions, AreRefusedByAReport) {
    Accelerator::Options options;
    options.memory.transport = Transport::At;
    GetParam().change(options);
    const Reported report = refusal(DegsConfig(), options);
    EXPECT_EQ(report.type, "/DeGS/accelerator/options");
    EXPECT_THAT(report.text, HasSubstr("refused: "));
    EXPECT_THAT(report.text, HasSubstr(GetParam().text));
}

constexpr WrongOptions kWrongOptions[] = {
    {"NoTransaction", [](auto& o) { o.memory.outstanding = 0; }, "memory.outstanding is 0"},
    {"NoTransactionOfAStream", [](auto& o) { o.memory.outstanding_per_stream = 0; },
     "memory.outstanding_per_stream is 0"},
    {"BurstsOfNoPowerOfTwo", [](auto& o) { o.memory.burst_bytes = 48; },
     "memory.burst_bytes is 48"},
    {"BurstsBelowAWord", [](auto& o) { o.memory.burst_bytes = 2; }, "memory.burst_bytes is 2"},
    {"FullBurstsOfNoSize", [](auto& o) { o.memory.burst_ends = BurstEnds::FullBursts; },
     "memory.burst_bytes is 0"},
    {"ABoundWithoutBursts", [](auto& o) { o.memory.lt_outstanding = 4; },
     "memory.burst_bytes is 0"},
    {"MoreLeakageThanThereIs", [](auto& o) { o.power.gated_leakage = 2; }, "power.gated_leakage"},
    {"ASupplyThatNeverComesBack", [](auto& o) { o.power.wake_ns = NAN; }, "power.wake_ns"},
    {"NoPixels", [](auto& o) { o.limits.pixels = 0; }, "limits"},
    {"NoGaussians", [](auto& o) { o.limits.gaussians = 0; }, "limits"},
    {"TooManyGaussians",
     [](auto& o) { o.limits.gaussians = AcceleratorOptions::kMostGaussians + 1; }, "2^30"},
};
INSTANTIATE_TEST_SUITE_P(All, SmallRunOptions, ::testing::ValuesIn(kWrongOptions),
                         [](const auto& wrong) { return wrong.param.name; });

// Whoever keeps reports from throwing gets no accelerator either.
TEST_F(SmallRunReports, WithoutThrowingReportsARefusalIsAStandardException) {
    sc_core::sc_report_handler::set_actions(reports::kConfig, sc_core::SC_ERROR,
                                            sc_core::SC_DO_NOTHING);
    DegsConfig config;
    config.scheduler.banks = 0;
    EXPECT_THROW(Accelerator("refused", config), std::invalid_argument);
    EXPECT_EQ(reported().size(), 1U);
}

TEST_F(SmallRunReports, AClockPortOnASignal) {
    Platform p("p", DegsConfig(), test_cloud());
    sc_core::sc_signal<bool> signal("signal");
    p.accelerator.clk.bind(signal);
    p.host.script = [](Host&) {};
    EXPECT_THROW(sc_core::sc_start(), sc_core::sc_report);
    ASSERT_EQ(reported().size(), 1U);
    EXPECT_EQ(reported().front().type, "/DeGS/accelerator/clock");
    EXPECT_THAT(reported().front().text, HasSubstr("not an sc_clock"));
}

TEST_F(SmallRunReports, AClockThatTheResolutionOfTimeCannotShow) {
    sc_core::sc_set_time_resolution(1, sc_core::SC_NS);
    const Reported report = refusal(DegsConfig());
    EXPECT_EQ(report.type, "/DeGS/accelerator/clock");
    EXPECT_THAT(report.text, HasSubstr("too coarse"));
}

TEST_F(SmallRunReports, AClockThatTheResolutionOfTimeChanges) {
    sc_core::sc_set_time_resolution(100, sc_core::SC_PS);
    DegsConfig config;
    config.clock_ghz = 0.8; // 1.25 ns
    const Platform p("p", config, test_cloud());
    ASSERT_EQ(reported().size(), 1U);
    EXPECT_EQ(reported().front().severity, sc_core::SC_WARNING);
    EXPECT_EQ(reported().front().type, "/DeGS/accelerator/clock");
    EXPECT_THAT(reported().front().text, HasSubstr("0.800000 GHz into 1300 ps"));
}

TEST_F(SmallRunReports, AQuantumThatIsNotThere) {
    Accelerator::Options options;
    options.memory.pacing = Pacing::Quantum;
    Platform p("p", DegsConfig(), test_cloud(),
               std::make_unique<PlainMemory>("memory", kMemoryBytes, Timing::Annotated), options);
    p.host.script = [](Host&) {};
    sc_core::sc_start();
    ASSERT_EQ(reported().size(), 1U);
    EXPECT_EQ(reported().front().severity, sc_core::SC_WARNING);
    EXPECT_EQ(reported().front().type, "/DeGS/accelerator/options");
    EXPECT_THAT(reported().front().text, HasSubstr("no global quantum"));
}

TEST_F(SmallRunReports, NothingOfAnAcceleratorWithUnboundPorts) {
    const GaussianCloud cloud = test_cloud();
    Accelerator accelerator("accelerator", DegsConfig());
    PlainMemory memory("memory", kMemoryBytes, Timing::Annotated);
    Host host("host");
    sc_core::sc_signal<bool> unused("unused");
    accelerator.mem.bind(memory.in); // and neither irq, reset_n nor clk
    host.out.bind(accelerator.registers);
    host.irq.bind(unused);
    std::vector<unsigned char> geometry;
    std::vector<unsigned char> sh;
    encode_scene(cloud, geometry, sh);
    std::copy(geometry.begin(), geometry.end(), memory.bytes.begin());
    std::copy(sh.begin(), sh.end(), memory.bytes.begin() + kSh);
    host.script = [&](Host& self) {
        program(self, cloud, test_camera());
        self.write(Register::IrqEnable, kIrqDone);
        self.write(Register::Control, kControlStart);
        while ((self.read(Register::Status) & kStatusBusy) != 0) {
            sc_core::wait(sc_core::sc_time(1, sc_core::SC_US));
        }
        EXPECT_EQ(self.read(Register::Status), kStatusDone);
    };
    sc_core::sc_start();
    EXPECT_TRUE(host.finished);
    EXPECT_TRUE(reported().empty());
}

TEST(SmallRunAcceleratorOptions, AreKeys) {
    Accelerator::Options options;
    options.set("fidelity", "strict");
    options.set("limits.pixels", "640");
    options.set("memory.transport", "at");
    options.set("memory.outstanding", "3");
    options.set("memory.pacing", "quantum");
    EXPECT_EQ(options.fidelity, Fidelity::Strict);
    EXPECT_EQ(options.limits.pixels, 640U);
    EXPECT_EQ(options.memory.transport, Transport::At);
    EXPECT_EQ(options.memory.outstanding, 3U);
    EXPECT_EQ(options.memory.pacing, Pacing::Quantum);
    EXPECT_THROW(options.set("limits.gaussians", "0"), InputError);
    EXPECT_THROW(options.set("limits.gaussians", "1073741825"), InputError);
    options.set("limits.gaussians", "1073741824");
    EXPECT_EQ(options.limits.gaussians, 1U << 30U);
    EXPECT_THROW(options.set("memory.transport", "axi"), InputError);
    options.set("power.gated_leakage", "0.125");
    EXPECT_EQ(options.power.gated_leakage, 0.125);
    EXPECT_THROW(options.set("power.gated_leakage", "1.5"), InputError);
    EXPECT_THROW(options.set("power.wake_ns", "-1"), InputError);
}

/// Ends a response that it has not begun.
class EndingTarget : public sc_core::sc_module {
public:
    tlm_utils::simple_target_socket<EndingTarget> in;
    explicit EndingTarget(const sc_core::sc_module_name& name)
        : sc_core::sc_module(name), in("in") {
        in.register_nb_transport_fw(this, &EndingTarget::forward);
    }

private:
    tlm::tlm_sync_enum forward(tlm::tlm_generic_payload& /*payload*/, tlm::tlm_phase& phase,
                               sc_core::sc_time& /*delay*/) {
        phase = tlm::END_RESP;
        return tlm::TLM_UPDATED;
    }
};

TEST_F(SmallRunReports, APhaseThatTheBaseProtocolForbids) {
    Accelerator::Options options;
    options.memory.transport = Transport::At;
    const GaussianCloud cloud = test_cloud();
    Platform p("p", DegsConfig(), cloud, nullptr, options);
    EndingTarget target("target");
    p.mem().bind(target.in);
    p.broken = {Rule::Phase};
    p.host.script = [&](Host& host) {
        program(host, cloud, test_camera());
        host.render();
    };
    EXPECT_THROW(sc_core::sc_start(), sc_core::sc_report);
    ASSERT_FALSE(reported().empty());
    EXPECT_EQ(reported().front().type, "/DeGS/accelerator/protocol");
    EXPECT_EQ(reported().front().severity, sc_core::SC_ERROR);
    EXPECT_THAT(reported().front().text, HasSubstr("p.gateway"));
}

} // namespace
} // namespace degs::test
