// SPDX-License-Identifier: Apache-2.0
// Every instruction that computes, on edge values and on random ones, against 64-bit arithmetic.
#include <functional>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/riscv/machine.hpp"

namespace rv32::test {
namespace {

using Value = std::uint32_t;

std::int64_t s(Value v) {
    return v < 0x80000000U ? std::int64_t{v} : std::int64_t{v} - (std::int64_t{1} << 32U);
}
std::uint64_t u(Value v) {
    return v;
}
Value word(std::int64_t v) {
    return static_cast<Value>(static_cast<std::uint64_t>(v));
}
/// The quotient rounded down of a division by 2^by.
std::int64_t floor_shift(std::int64_t v, unsigned by) {
    const std::int64_t divisor = std::int64_t{1} << by;
    return (v - ((v % divisor + divisor) % divisor)) / divisor;
}
/// Upper half of a product, from one of 128 bits.
__extension__ using Wide = __int128;
__extension__ using Pattern = unsigned __int128;
Value upper(Wide a, Wide b) {
    return static_cast<Value>(static_cast<Pattern>(a * b) >> 32U);
}

struct Operation {
    std::string name;
    Value funct7, funct3;
    std::function<Value(Value, Value)> expected;
    bool has_immediate = false; ///< whether there is a form with an immediate
};
std::ostream& operator<<(std::ostream& out, const Operation& operation) {
    return out << operation.name;
}

const std::vector<Operation>& operations() {
    static const std::vector<Operation> all = {
        {"add", 0, 0, [](Value a, Value b) { return word(s(a) + s(b)); }, true},
        {"sub", 32, 0, [](Value a, Value b) { return word(s(a) - s(b)); }},
        {"sll", 0, 1, [](Value a, Value b) { return word(std::int64_t(u(a) << (b % 32))); }, true},
        {"slt", 0, 2, [](Value a, Value b) { return Value(s(a) < s(b)); }, true},
        {"sltu", 0, 3, [](Value a, Value b) { return Value(u(a) < u(b)); }, true},
        {"xor", 0, 4, [](Value a, Value b) { return (a | b) - (a & b); }, true},
        {"srl", 0, 5, [](Value a, Value b) { return Value(u(a) / (1ULL << (b % 32))); }, true},
        {"sra", 32, 5, [](Value a, Value b) { return word(floor_shift(s(a), b % 32)); }, true},
        {"or", 0, 6, [](Value a, Value b) { return ~(~a & ~b); }, true},
        {"and", 0, 7, [](Value a, Value b) { return ~(~a | ~b); }, true},
        {"mul", 1, 0, [](Value a, Value b) { return word(s(a) * s(b)); }},
        {"mulh", 1, 1, [](Value a, Value b) { return upper(s(a), s(b)); }},
        {"mulhsu", 1, 2, [](Value a, Value b) { return upper(s(a), Wide(u(b))); }},
        {"mulhu", 1, 3, [](Value a, Value b) { return upper(Wide(u(a)), Wide(u(b))); }},
        // Volume I, table 7.1; -2^31 / -1 is 2^31 in 64 bits, whose low word is -2^31.
        {"div", 1, 4, [](Value a, Value b) { return b == 0 ? word(-1) : word(s(a) / s(b)); }},
        {"divu", 1, 5, [](Value a, Value b) { return b == 0 ? word(-1) : Value(u(a) / u(b)); }},
        {"rem", 1, 6, [](Value a, Value b) { return b == 0 ? a : word(s(a) % s(b)); }},
        {"remu", 1, 7, [](Value a, Value b) { return b == 0 ? a : Value(u(a) % u(b)); }},
    };
    return all;
}

std::vector<Value> values() {
    std::vector<Value> all = {0,          1,          2,          0xFFFFFFFF,
                              0xFFFFFFFE, 0x80000000, 0x80000001, 0x7FFFFFFF,
                              0x7FFFFFFE, 0x0000FFFF, 0xFFFF0000, 0x00010000,
                              0x55555555, 0xAAAAAAAA, 0x800,      0xFFFFF800};
    for (Value shift = 3; shift < 64; ++shift) {
        all.push_back(shift);
    }
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
        all.push_back(static_cast<Value>(random()));
    }
    return all;
}

class RiscvOperation : public ::testing::TestWithParam<Operation> {};

TEST_P(RiscvOperation, AgreesWithArithmeticOf64Bits) {
    Machine machine;
    for (const Value a : values()) {
        for (const Value b : values()) {
            machine.core.set_x(5, a);
            machine.core.set_x(6, b);
            machine.run(r_type(GetParam().funct7, GetParam().funct3, 7, 5, 6));
            ASSERT_EQ(machine.core.x(7), GetParam().expected(a, b)) << a << ", " << b;
            ASSERT_EQ(machine.core.pc(), 0x1004U);
        }
    }
}

TEST_P(RiscvOperation, AgreesWithItsFormWithAnImmediate) {
    if (!GetParam().has_immediate) {
        return;
    }
    Machine machine;
    const bool shift = GetParam().funct3 % 4 == 1;
    for (const Value a : values()) {
        for (std::int32_t i = shift ? 0 : -2048; i < (shift ? 32 : 2048); i += shift ? 1 : 13) {
            machine.core.set_x(5, a);
            machine.run(i_type(0x13, GetParam().funct3, 7, 5,
                               shift ? static_cast<std::int32_t>(GetParam().funct7 << 5U) + i : i));
            ASSERT_EQ(machine.core.x(7), GetParam().expected(a, word(i))) << a << ", " << i;
        }
    }
}

TEST_P(RiscvOperation, MayWriteItsOperandsAndNotRegisterZero) {
    Machine machine;
    const Value expected = GetParam().expected(0x80000005, 0x80000005);
    machine.core.set_x(9, 0x80000005);
    machine.run(r_type(GetParam().funct7, GetParam().funct3, 0, 9, 9));
    EXPECT_EQ(machine.core.x(0), 0U);
    machine.run(r_type(GetParam().funct7, GetParam().funct3, 9, 9, 9));
    EXPECT_EQ(machine.core.x(9), expected);
}

INSTANTIATE_TEST_SUITE_P(All, RiscvOperation, ::testing::ValuesIn(operations()),
                         [](const auto& test) { return test.param.name; });

TEST(RiscvUpper, LoadsImmediatesAndAddsThemToThePc) {
    Machine machine;
    machine.run(0x89ABC000U | 7U << 7U | 0x37U);
    EXPECT_EQ(machine.core.x(7), 0x89ABC000U);
    machine.run(0xFFFFF000U | 7U << 7U | 0x17U, 0x2000);
    EXPECT_EQ(machine.core.x(7), 0x1000U);
}

} // namespace
} // namespace rv32::test
