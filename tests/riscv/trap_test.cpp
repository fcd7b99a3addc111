// SPDX-License-Identifier: Apache-2.0
// Control and status registers, exceptions, the external interrupt, mret and wfi.
#include <gtest/gtest.h>

#include "tests/riscv/machine.hpp"

namespace rv32::test {
namespace {

constexpr std::uint32_t kMret = 0x30200073, kWfi = 0x10500073, kNop = 0x13;

std::uint32_t csr_op(std::uint32_t kind, std::uint32_t csr, std::uint32_t rd, std::uint32_t rs1) {
    return csr << 20U | rs1 << 15U | kind << 12U | rd << 7U | 0x73U;
}

TEST(RiscvCsr, EachInstructionReadsOldAndWritesNew) {
    constexpr std::uint32_t old = 0xF0F0F0F0, operand = 0x0FF0000F;
    const std::uint32_t expected[] = {0, operand, old | operand, old & ~operand};
    for (const std::uint32_t kind : {1U, 2U, 3U}) {
        Machine machine;
        machine.core.write_csr(kMscratch, old);
        machine.core.set_x(5, operand);
        machine.run(csr_op(kind, kMscratch, 7, 5));
        EXPECT_EQ(machine.core.x(7), old);
        EXPECT_EQ(machine.csr(kMscratch), expected[kind]);
        machine.core.write_csr(kMscratch, old);
        machine.run(csr_op(kind | 4U, kMscratch, 7, 21));
        EXPECT_EQ(machine.core.x(7), old);
        EXPECT_EQ(machine.csr(kMscratch), kind == 1 ? 21U : kind == 2 ? old | 21U : old & ~21U);
    }
}

TEST(RiscvCsr, SetAndClearOfNothingDoNotWriteAReadOnlyRegister) {
    Machine machine;
    machine.core.write_csr(kMtvec, kHandler);
    machine.run(csr_op(2, kMhartid, 7, 0));
    EXPECT_EQ(machine.core.pc(), 0x1004U);
    EXPECT_EQ(machine.core.x(7), 0U);
    machine.run(csr_op(1, kMhartid, 7, 0));
    EXPECT_EQ(machine.csr(kMcause), kIllegalInstruction);
}

TEST(RiscvCsr, FieldsThatAreNotThereStayAsTheyAre) {
    Machine machine;
    for (const std::uint32_t csr : {kMstatus, kMie, kMip, kMtvec, kMepc, kMisa}) {
        EXPECT_TRUE(machine.core.write_csr(csr, 0xFFFFFFFF));
    }
    EXPECT_EQ(machine.csr(kMstatus), kMppBits | kMieBit | kMpieBit);
    EXPECT_EQ(machine.csr(kMie), kExternalBit);
    EXPECT_EQ(machine.csr(kMip), 0U);
    EXPECT_EQ(machine.csr(kMtvec), 0xFFFFFFFDU);
    EXPECT_EQ(machine.csr(kMepc), 0xFFFFFFFCU);
    EXPECT_EQ(machine.csr(kMisa), 0x40001100U);
}

TEST(RiscvTrap, IllegalInstructionsTrapWithTheirWord) {
    for (const std::uint32_t word : {
             0x00000000U,
             0xFFFFFFFFU,
             0x00000001U, // compressed
             r_type(2, 0, 7, 5, 6),
             r_type(32, 4, 7, 5, 6),
             r_type(32, 1, 7, 5, 6),
             i_type(0x13, 1, 7, 5, 32),
             i_type(0x13, 5, 7, 5, 0x420), // shifts by more than 31
             i_type(0x03, 3, 7, 5, 0),
             i_type(0x03, 6, 7, 5, 0),
             i_type(0x03, 7, 7, 5, 0),
             s_type(3, 5, 6, 0),
             s_type(4, 5, 6, 0),
             b_type(2, 5, 6, 8),
             b_type(3, 5, 6, 8),
             i_type(0x67, 1, 7, 5, 0),
             csr_op(1, 0x180, 7, 5),
             csr_op(4, kMscratch, 7, 5),
             0x10200073U, // sret
             0x0000002FU, // atomic
         }) {
        Machine machine;
        machine.core.write_csr(kMtvec, kHandler);
        machine.run(word);
        EXPECT_EQ(machine.core.pc(), kHandler) << std::hex << word;
        EXPECT_EQ(machine.csr(kMcause), kIllegalInstruction);
        EXPECT_EQ(machine.csr(kMtval), word);
        EXPECT_EQ(machine.csr(kMepc), 0x1000U);
        EXPECT_EQ(machine.core.x(7), 0U);
    }
}

TEST(RiscvTrap, CallsAndBreakpointsSaveTheirOwnAddress) {
    Machine machine;
    machine.core.write_csr(kMtvec, kHandler);
    machine.run(0x00000073);
    EXPECT_EQ(machine.csr(kMcause), kMachineCall);
    EXPECT_EQ(machine.csr(kMepc), 0x1000U);
    machine.run(0x00100073, 0x1100);
    EXPECT_EQ(machine.csr(kMcause), kBreakpoint);
    EXPECT_EQ(machine.csr(kMepc), 0x1100U);
    machine.run(0x0FF0000F); // a fence is no trap
    EXPECT_EQ(machine.core.pc(), 0x1004U);
}

/// A machine whose line is high and whose mie is set.
struct Interrupted : Machine {
    Interrupted() {
        core.write_csr(kMtvec, kHandler);
        core.write_csr(kMie, kExternalBit);
        core.write_csr(kMstatus, kMieBit);
        core.set_external_interrupt(true);
    }
};

TEST(RiscvInterrupt, ComesBeforeTheInstructionAndMretReturnsToIt) {
    Interrupted machine;
    machine.run(i_type(0x13, 0, 7, 0, 5));
    EXPECT_EQ(machine.core.pc(), kHandler);
    EXPECT_EQ(machine.csr(kMcause), 0x8000000BU);
    EXPECT_EQ(machine.csr(kMepc), 0x1000U);
    EXPECT_EQ(machine.core.x(7), 0U);
    EXPECT_EQ(machine.csr(kMstatus), kMppBits | kMpieBit);
    EXPECT_EQ(machine.csr(kMip), kExternalBit);
    machine.run(kNop, kHandler); // the handler is not interrupted
    EXPECT_EQ(machine.core.pc(), kHandler + 4);
    machine.core.set_external_interrupt(false);
    machine.run(kMret, kHandler + 4);
    EXPECT_EQ(machine.core.pc(), 0x1000U);
    EXPECT_EQ(machine.csr(kMstatus), kMppBits | kMpieBit | kMieBit);
    machine.core.step();
    EXPECT_EQ(machine.core.x(7), 5U);
}

TEST(RiscvInterrupt, WaitsForBothEnables) {
    Interrupted none, no_source;
    none.core.write_csr(kMstatus, 0);
    none.run(kNop);
    EXPECT_EQ(none.core.pc(), 0x1004U);
    no_source.core.write_csr(kMie, 0);
    no_source.run(kNop);
    EXPECT_EQ(no_source.core.pc(), 0x1004U);
}

TEST(RiscvInterrupt, IsVectoredIfAsked) {
    Interrupted machine;
    machine.core.write_csr(kMtvec, kHandler | 1U);
    machine.run(kNop);
    EXPECT_EQ(machine.core.pc(), kHandler + 44);
    machine.run(0x00000073); // exceptions are not
    EXPECT_EQ(machine.core.pc(), kHandler);
}

// mstatus of a program that sets MPIE to 0 says that interrupts stay off.
TEST(RiscvInterrupt, StayAsTheyWereBeforeTheTrap) {
    for (const bool enabled : {false, true}) {
        Machine machine;
        machine.core.write_csr(kMstatus, enabled ? kMpieBit : 0);
        machine.core.write_csr(kMepc, 0x2000);
        machine.run(kMret);
        EXPECT_EQ(machine.core.pc(), 0x2000U);
        EXPECT_EQ(machine.csr(kMstatus), kMppBits | kMpieBit | (enabled ? kMieBit : 0));
    }
}

TEST(RiscvCsr, CountersHaveTwoHalves) {
    Machine machine;
    machine.run(kNop);
    machine.run(0x00000073); // a cycle, but no instruction that is done
    machine.run(kNop);
    EXPECT_EQ(machine.csr(kMcycle), 3U);
    EXPECT_EQ(machine.csr(kMinstret), 2U);
    EXPECT_EQ(machine.csr(kMcycleHigh), 0U);
    EXPECT_EQ(machine.csr(kMinstretHigh), 0U);
}

TEST(RiscvWfi, SleepsUntilTheLineEvenIfItMayNotTrap) {
    Machine machine;
    machine.core.write_csr(kMie, kExternalBit);
    machine.run(kWfi);
    EXPECT_TRUE(machine.core.waiting());
    machine.core.step();
    EXPECT_EQ(machine.csr(kMcycle), 1U); // as the clock of a core that sleeps
    EXPECT_EQ(machine.core.pc(), 0x1004U);
    EXPECT_EQ(machine.core.retired(), 1U);
    machine.core.set_external_interrupt(true);
    EXPECT_FALSE(machine.core.waiting());
    machine.run(kNop, 0x1004);
    EXPECT_EQ(machine.core.pc(), 0x1008U);
}

TEST(RiscvWfi, DoesNotSleepWhileTheLineIsHigh) {
    Interrupted machine;
    machine.core.write_csr(kMstatus, 0);
    machine.run(kWfi);
    EXPECT_FALSE(machine.core.waiting());
}

} // namespace
} // namespace rv32::test
