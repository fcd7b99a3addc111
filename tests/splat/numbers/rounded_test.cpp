// SPDX-License-Identifier: Apache-2.0
#include "splat/numbers/rounded.hpp"

#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "splat/model/vector3.hpp"

namespace degs {
namespace {

std::uint32_t bits_of(float x) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    return bits;
}

void expect_same(const Rounded& rounded, float native) {
    const auto narrow = static_cast<float>(rounded.value());
    if (std::isnan(native)) {
        EXPECT_TRUE(std::isnan(rounded.value()));
        return;
    }
    EXPECT_EQ(rounded.value(), static_cast<double>(narrow)); // it is a float
    ASSERT_EQ(bits_of(narrow), bits_of(native)) << native;
}

// Any patterns, subnormals, infinities and NaN included.
TEST(Rounded, IsTheMachinesFloatToTheBit) {
    const RoundedNumbers numbers(parse_format("fp32"));
    std::mt19937 random(3);
    int finite = 0;
    for (int i = 0; i < 400000; ++i) {
        float a = 0;
        float b = 0;
        auto pattern = static_cast<std::uint32_t>(random());
        std::memcpy(&a, &pattern, sizeof a);
        // Half of the pairs are near each other, so that sums cancel.
        pattern = i % 2 == 0 ? static_cast<std::uint32_t>(random())
                             : pattern ^ (static_cast<std::uint32_t>(random()) & 0x80FFFFFFU);
        std::memcpy(&b, &pattern, sizeof b);
        const Rounded x = numbers(double{a});
        const Rounded y = numbers(double{b});
        expect_same(x + y, a + b);
        expect_same(x - y, a - b);
        expect_same(x * y, a * b);
        expect_same(x / y, a / b);
        expect_same(root_of(x), root_of(a));
        expect_same(log_of(x), log_of(a));
        EXPECT_EQ(x < y, a < b);
        EXPECT_EQ(x > y, a > b);
        EXPECT_EQ(x >= y, a >= b);
        finite += static_cast<int>(std::isfinite(a * b));
    }
    EXPECT_GT(finite, 100000);
}

TEST(Rounded, RoundsEveryResultOnce) {
    const RoundedNumbers half(parse_format("fp16"));
    EXPECT_EQ(half(1.0 / 3).value(), 1365.0 / 4096); // 0.010101010101 without its last bits
    EXPECT_EQ((half(2048) + half(1)).value(), 2048); // ties go to even
    EXPECT_EQ((half(2048) + half(3)).value(), 2052);
    EXPECT_EQ((half(300) * half(300)).value(), INFINITY);
    EXPECT_EQ(root_of(half(2)).value(), 1448.0 / 1024);
    const Vector3<Rounded> v = vector_in(half, {2048, 1, 1});
    EXPECT_EQ(dot(v, vector_in(half, {1, 1, 1})).value(), 2048); // from x to z, one by one
    EXPECT_EQ(dot(vector_in(half, {1, 1, 2048}), vector_in(half, {1, 1, 1})).value(), 2050);
}

// Saturation would hide that a result is wrong.
TEST(Rounded, LeavesFixedFormatsForInfinity) {
    const RoundedNumbers fixed(parse_format("q4.4")); // up to 7.9375
    EXPECT_EQ((fixed(7.9375) + fixed(0)).value(), 7.9375);
    EXPECT_EQ((fixed(7.9375) + fixed(0.0625)).value(), INFINITY);
    EXPECT_EQ((fixed(-4) * fixed(4)).value(), -INFINITY);
    EXPECT_EQ((fixed(1) / fixed(0)).value(), INFINITY);
    EXPECT_TRUE(std::isnan((fixed(0) / fixed(0)).value()));
    EXPECT_EQ((fixed(1) / fixed(3)).value(), 5.0 / 16);
}

} // namespace
} // namespace degs
