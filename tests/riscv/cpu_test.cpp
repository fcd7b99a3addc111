// SPDX-License-Identifier: Apache-2.0
#include "cpu.hpp"

#include <stdexcept>

#include <gmock/gmock.h>

namespace rv32::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(RiscvCpu, APeriodThatTheResolutionTurnsIntoNothingIsRefused) {
    sc_core::sc_set_time_resolution(10, sc_core::SC_NS);
    EXPECT_THAT([] { Cpu cpu("cpu", Firmware{}, sc_core::sc_time(1, sc_core::SC_NS)); },
                ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("cpu: "), HasSubstr("10 ns"))));
}

} // namespace
} // namespace rv32::test
