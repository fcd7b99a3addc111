// SPDX-License-Identifier: Apache-2.0
// Jumps, branches, loads and stores, with their exceptions.
#include <array>

#include <gtest/gtest.h>

#include "tests/riscv/machine.hpp"

namespace rv32::test {
namespace {

/// A machine whose traps go to kHandler.
struct Trapping : Machine {
    Trapping() { core.write_csr(kMtvec, kHandler); }
    void expect_trap(std::uint32_t cause, std::uint32_t value, std::uint32_t at = 0x1000) const {
        EXPECT_EQ(core.pc(), kHandler);
        EXPECT_EQ(csr(kMcause), cause);
        EXPECT_EQ(csr(kMtval), value);
        EXPECT_EQ(csr(kMepc), at);
        EXPECT_EQ(core.retired(), 0U);
    }
};

TEST(RiscvJump, LinksAndReachesBothWays) {
    for (const std::int32_t offset : {4, 8, 2044, 2048, 4096, 0x6000, -4, -2048, -4096}) {
        Machine machine;
        machine.run(j_type(1, offset), 0x4000);
        EXPECT_EQ(machine.core.pc(), 0x4000U + static_cast<std::uint32_t>(offset)) << offset;
        EXPECT_EQ(machine.core.x(1), 0x4004U);
    }
    Machine far;
    far.run(j_type(0, 0xFFFFC), 0);
    EXPECT_EQ(far.core.pc(), 0xFFFFCU);
    far.run(j_type(0, -0x100000), 0);
    EXPECT_EQ(far.core.pc(), 0xFFF00000U);
}

TEST(RiscvJump, ThroughARegisterClearsBitZeroAndLinksLast) {
    Machine machine;
    machine.core.set_x(5, 0x2001);
    machine.run(i_type(0x67, 0, 5, 5, -8));
    EXPECT_EQ(machine.core.pc(), 0x1FF8U);
    EXPECT_EQ(machine.core.x(5), 0x1004U);
}

TEST(RiscvJump, ToAHalfWordTrapsAndDoesNotLink) {
    Trapping jal, jalr, branch;
    jal.run(j_type(1, 6));
    jal.expect_trap(kMisalignedFetch, 0x1006);
    EXPECT_EQ(jal.core.x(1), 0U);
    jalr.core.set_x(5, 0x2002);
    jalr.run(i_type(0x67, 0, 1, 5, 0));
    jalr.expect_trap(kMisalignedFetch, 0x2002);
    EXPECT_EQ(jalr.core.x(1), 0U);
    branch.run(b_type(0, 0, 0, 2));
    branch.expect_trap(kMisalignedFetch, 0x1002);
}

TEST(RiscvBranch, HoldsAsItsRelation) {
    constexpr std::array<std::uint32_t, 7> values = {0,          1,          0xFFFFFFFF, 0x80000000,
                                                     0x7FFFFFFF, 0x80000001, 2};
    for (const std::uint32_t a : values) {
        for (const std::uint32_t b : values) {
            const bool less = (a ^ 0x80000000U) < (b ^ 0x80000000U); // two's complement
            const std::array<bool, 8> holds = {a == b, a != b, false, false,
                                               less,   !less,  a < b, a >= b};
            for (const std::uint32_t kind : {0U, 1U, 4U, 5U, 6U, 7U}) {
                for (const std::int32_t offset : {-4096, -2048, -32, 8, 32, 2048, 4092}) {
                    Machine machine;
                    machine.core.set_x(5, a);
                    machine.core.set_x(6, b);
                    machine.run(b_type(kind, 5, 6, offset), 0x2000);
                    ASSERT_EQ(machine.core.pc(),
                              0x2000U + (holds.at(kind) ? static_cast<std::uint32_t>(offset) : 4U))
                        << kind << ": " << a << ", " << b << ", " << offset;
                }
            }
        }
    }
}

TEST(RiscvMemory, LoadsExtendAsTheirKindSays) {
    Machine machine;
    machine.store(0x2000, 4, 0x80FF7F01);
    machine.core.set_x(5, 0x2004);
    const auto loaded = [&machine](std::uint32_t kind, std::int32_t offset) {
        machine.run(i_type(0x03, kind, 7, 5, offset));
        return machine.core.x(7);
    };
    const std::array<std::uint32_t, 4> bytes = {0x01, 0x7F, 0xFFFFFFFF, 0xFFFFFF80};
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::int32_t offset = static_cast<std::int32_t>(i) - 4;
        EXPECT_EQ(loaded(0, offset), bytes.at(i));
        EXPECT_EQ(loaded(4, offset), bytes.at(i) & 0xFFU);
    }
    EXPECT_EQ(loaded(1, -4), 0x7F01U);
    EXPECT_EQ(loaded(1, -2), 0xFFFF80FFU);
    EXPECT_EQ(loaded(5, -2), 0x80FFU);
    EXPECT_EQ(loaded(2, -4), 0x80FF7F01U);
}

TEST(RiscvMemory, StoresChangeTheirBytesOnly) {
    for (const std::uint32_t size : {0U, 1U, 2U}) {
        for (std::uint32_t at = 0; at < 4; at += 1U << size) {
            Machine machine;
            machine.store(0x2000, 4, 0x11223344);
            machine.core.set_x(5, 0x2000);
            machine.core.set_x(6, 0xA1B2C3D4);
            machine.run(s_type(size, 5, 6, static_cast<std::int32_t>(at)));
            for (std::uint32_t i = 0; i < 4; ++i) {
                const bool written = i >= at && i < at + (1U << size);
                EXPECT_EQ(machine.bytes[0x2000 + i], written ? 0xA1B2C3D4U >> 8 * (i - at) & 255U
                                                             : 0x11223344U >> 8 * i & 255U);
            }
        }
    }
    Machine below;
    below.core.set_x(5, 0x2800);
    below.core.set_x(6, 0xA1B2C3D4);
    below.run(s_type(2, 5, 6, -2048));
    EXPECT_EQ(below.bytes[0x2003], 0xA1);
}

TEST(RiscvMemory, MisalignedAccessesTrap) {
    for (const std::uint32_t at : {0x2001U, 0x2002U, 0x2003U}) {
        for (const std::uint32_t kind : {1U, 5U, 2U}) {
            if (kind != 2 && at % 2 == 0) {
                continue;
            }
            Trapping load, store;
            load.core.set_x(5, at);
            load.run(i_type(0x03, kind, 7, 5, 0));
            load.expect_trap(kMisalignedLoad, at);
            store.core.set_x(5, at);
            store.run(s_type(kind & 3U, 5, 6, 0));
            store.expect_trap(kMisalignedStore, at);
        }
    }
}

TEST(RiscvMemory, AccessesToNothingTrap) {
    Trapping load, store, fetch;
    load.core.set_x(5, 0x10000);
    load.run(i_type(0x03, 2, 7, 5, 0));
    load.expect_trap(kLoadFault, 0x10000);
    store.core.set_x(5, 0xFFFFFFFC);
    store.run(s_type(2, 5, 6, 0));
    store.expect_trap(kStoreFault, 0xFFFFFFFC);
    fetch.core.set_pc(0x20000);
    fetch.core.step();
    fetch.expect_trap(kFetchFault, 0x20000, 0x20000);
}

} // namespace
} // namespace rv32::test
