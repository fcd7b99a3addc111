// SPDX-License-Identifier: Apache-2.0
// The keys of an accelerator as parameters of SystemC CCI, where the build has found it
// (DEGS_CCI_PREFIX).
#include <gtest/gtest.h>

#ifdef DEGS_HAS_CCI

#include <gmock/gmock.h>

#include "degs/cci.hpp"
#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {
namespace {

class SmallRunCciParameters : public ::testing::Test {
protected:
    SmallRunCciParameters() {
        cci::cci_register_broker(own_);
        sc_core::sc_report_handler::set_actions(reports::kConfig, sc_core::SC_WARNING,
                                                sc_core::SC_DO_NOTHING);
    }
    void preset(const std::string& name, const cci::cci_value& value) {
        own_.set_preset_cci_value(name, value, cci::cci_originator("platform"));
    }
    static cci::cci_broker_handle broker() {
        return cci::cci_get_global_broker(cci::cci_originator("platform"));
    }
    static std::string refusal() {
        try {
            const CciParameters parameters(broker(), "top.gpu", Design());
        } catch (const sc_core::sc_report& report) {
            EXPECT_STREQ(report.get_msg_type(), reports::kConfig);
            return report.get_msg();
        }
        return "";
    }

private:
    cci_utils::broker own_{"broker"};
};

TEST_F(SmallRunCciParameters, PresetsReachTheConfigurationAndTheOptions) {
    preset("top.gpu.scheduler.banks", cci::cci_value(4));
    preset("top.gpu.clock_ghz", cci::cci_value(0.5));
    preset("top.gpu.scheduler.scoreboard", cci::cci_value(false));
    preset("top.gpu.pipeline.span_ends", cci::cci_value("exact"));
    preset("top.gpu.options.fidelity", cci::cci_value("strict"));
    preset("top.gpu.options.memory.outstanding", cci::cci_value(7));
    preset("other.gpu.scheduler.banks", cci::cci_value(2));
    const CciParameters parameters(broker(), "top.gpu", Design());
    const auto& config = dynamic_cast<const DegsConfig&>(parameters.design().accelerator());
    EXPECT_EQ(config.scheduler.banks, 4);
    EXPECT_EQ(config.clock_ghz, 0.5);
    EXPECT_FALSE(config.scheduler.scoreboard);
    EXPECT_EQ(config.pipeline.span_ends, SpanEnds::Exact);
    EXPECT_EQ(config.array.pes_per_bank, DegsConfig().array.pes_per_bank);
    EXPECT_EQ(parameters.options().fidelity, Fidelity::Strict);
    EXPECT_EQ(parameters.options().memory.outstanding, 7U);
    EXPECT_EQ(sc_core::sc_report_handler::get_count(reports::kConfig), 0);
}

TEST_F(SmallRunCciParameters, ToolsFindThemByNameWithTheirDescription) {
    const CciParameters parameters(broker(), "top.gpu", Design());
    cci::cci_broker_handle all = broker();
    EXPECT_EQ(all.get_param_handles().size(), parameters.size());
    EXPECT_GT(parameters.size(), 100U);
    const auto banks = all.get_param_handle("top.gpu.scheduler.banks");
    ASSERT_TRUE(banks.is_valid());
    EXPECT_FALSE(banks.get_description().empty());
    EXPECT_EQ(banks.get_cci_value().get_int64(), DegsConfig().scheduler.banks);
    EXPECT_TRUE(all.get_param_handle("top.gpu.options.memory.transport").is_valid());
}

TEST_F(SmallRunCciParameters, ValuesOutOfRangeAreRefusedByTheirNames) {
    preset("top.gpu.scheduler.banks", cci::cci_value(0));
    EXPECT_THAT(refusal(), ::testing::HasSubstr("top.gpu.scheduler.banks: 0 is not between 1 and"));
}

TEST_F(SmallRunCciParameters, ChoicesThatDoNotExistAreRefusedByTheirNames) {
    preset("top.gpu.options.memory.transport", cci::cci_value("axi"));
    EXPECT_EQ(refusal(), "top.gpu.options.memory.transport: 'axi' is none of lt, at");
}

TEST_F(SmallRunCciParameters, APresetThatIsNoParameterIsAWarning) {
    preset("top.gpu.scheduler.bank", cci::cci_value(4));
    const CciParameters parameters(broker(), "top.gpu", Design());
    EXPECT_EQ(sc_core::sc_report_handler::get_count(reports::kConfig, sc_core::SC_WARNING), 1);
}

TEST_F(SmallRunCciParameters, AnAcceleratorIsBuiltFromThemAndTheirRulesHold) {
    preset("p.frame_end.gate_latency_cycles", cci::cci_value(301));
    const GaussianCloud cloud = test_cloud();
    const CciParameters parameters(broker(), "p", Design());
    Platform p("p", parameters.design().accelerator(), cloud,
               std::make_unique<PlainMemory>("memory", kMemoryBytes, Timing::Annotated),
               parameters.options());
    Platform plain("plain", DegsConfig(), cloud);
    std::uint64_t cycles[2] = {};
    std::size_t which = 0;
    for (Platform* const platform : {&p, &plain}) {
        platform->host.script = [&cloud, &frame = cycles[which++]](Host& host) {
            program(host, cloud, test_camera());
            EXPECT_TRUE(host.render());
            frame = host.read_pair(Register::Cycles);
        };
    }
    sc_core::sc_start();
    EXPECT_EQ(cycles[0], cycles[1] + 301 - DegsConfig().frame_end.gate_latency_cycles);
}

} // namespace
} // namespace degs::test

#else

TEST(SmallRunCciParameters, AreSkippedWithoutCci) {
    GTEST_SKIP() << "the build has not found SystemC CCI (CMake variable DEGS_CCI_PREFIX)";
}

#endif
