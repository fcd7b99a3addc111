// SPDX-License-Identifier: Apache-2.0
// Rounding is tested on arrays of neighbours: compilers have dropped it in vectorised code only.
#include "splat/numbers/number_format.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "degs/error.hpp"

namespace degs {
namespace {

/// All values >= 0 of a 16-bit format in ascending order, decoded by the definition of the format.
std::vector<double> magnitudes(const NumberFormat& f) {
    std::vector<double> values;
    const int bits = f.storage_bits() - static_cast<int>(f.has_sign);
    for (int code = 0; code < 1 << bits; ++code) {
        if (f.kind == NumberFormat::Kind::Fixed) {
            values.push_back(code / std::pow(2.0, f.fraction_bits));
            continue;
        }
        const int exponent = code >> f.fraction_bits;
        const double mantissa = (code % (1 << f.fraction_bits)) / std::pow(2.0, f.fraction_bits);
        if (exponent == (1 << f.exponent_bits) - 1) {
            break; // infinity and NaN
        }
        values.push_back(exponent == 0 ? mantissa * std::pow(2.0, 1 - f.bias)
                                       : (1 + mantissa) * std::pow(2.0, exponent - f.bias));
    }
    return values;
}

std::vector<float> rounded(const NumberFormat& format, RoundFunction round,
                           std::vector<float> values) {
    round(LaneRounding(format), values.data(), values.size());
    return values;
}

/// What each of `inputs` must become; both signs, in vectors and one by one.
void expect_rounding(const NumberFormat& format, const std::vector<float>& inputs,
                     const std::vector<double>& expected) {
    const Rounder scalar(format);
    for (const float sign : {1.0F, -1.0F}) {
        std::vector<float> signed_inputs = inputs;
        for (float& x : signed_inputs) {
            x *= sign;
        }
        const double factor = sign > 0 ? 1.0 : format.has_sign ? -1.0 : 0.0;
        for (const RoundFunction round : round_variants()) {
            const std::vector<float> results = rounded(format, round, signed_inputs);
            for (std::size_t i = 0; i < inputs.size(); ++i) {
                const double value = expected[i] == 0 || factor == 0 ? 0 : factor * expected[i];
                ASSERT_EQ(static_cast<double>(results[i]), value)
                    << format.name() << " " << signed_inputs[i];
                ASSERT_EQ(scalar(static_cast<double>(signed_inputs[i])), value)
                    << format.name() << " " << signed_inputs[i];
            }
        }
    }
}

class SixteenBits : public testing::TestWithParam<const char*> {};

TEST_P(SixteenBits, ValuesStayAndWhatIsBetweenGoesToTheNearest) {
    const NumberFormat format = parse_format(GetParam());
    ASSERT_EQ(format.storage_bits(), 16);
    const std::vector<double> values = magnitudes(format);
    std::vector<float> inputs;
    std::vector<double> expected;
    const auto expect = [&](double input, double result) {
        inputs.push_back(static_cast<float>(input));
        ASSERT_EQ(static_cast<double>(inputs.back()), input) << "the test needs a float";
        expected.push_back(result);
    };
    for (std::size_t i = 0; i < values.size(); ++i) {
        expect(values[i], values[i]);
        if (i + 1 == values.size()) {
            continue;
        }
        const double middle = (values[i] + values[i + 1]) / 2;
        const auto as_float = static_cast<float>(middle);
        expect(middle, values[i + i % 2]); // codes alternate between even and odd
        expect(static_cast<double>(std::nextafter(as_float, 0.0F)), values[i]);
        expect(
            static_cast<double>(std::nextafter(as_float, std::numeric_limits<float>::infinity())),
            values[i + 1]);
    }
    expect_rounding(format, inputs, expected);
    EXPECT_EQ(values.back(), format.max());
    EXPECT_EQ(values[1], format.quantum());
}

TEST_P(SixteenBits, OverflowsAsDocumented) {
    const NumberFormat format = parse_format(GetParam());
    const std::vector<double> values = magnitudes(format);
    const double top = values.back();
    const double half = (top - values[values.size() - 2]) / 2;
    const bool fixed = format.kind == NumberFormat::Kind::Fixed;
    const double over = fixed ? top : std::numeric_limits<double>::infinity();
    const auto limit = static_cast<float>(top + half); // the tie: the next code would be even
    expect_rounding(format,
                    {std::nextafter(limit, 0.0F), limit,
                     std::nextafter(limit, std::numeric_limits<float>::infinity()), 3e38F,
                     std::numeric_limits<float>::infinity()},
                    {top, over, over, top > 3e38 ? Rounder(format)(3e38F) : over, over});
}

TEST_P(SixteenBits, NanStaysNanOrSaturates) {
    const NumberFormat format = parse_format(GetParam());
    const bool fixed = format.kind == NumberFormat::Kind::Fixed;
    for (const float nan : {std::nanf("1"), -std::nanf("2")}) {
        for (const RoundFunction round : round_variants()) {
            const std::vector<float> results = rounded(format, round, std::vector<float>(11, nan));
            for (const float result : results) {
                EXPECT_TRUE(fixed ? static_cast<double>(result) == format.max()
                                  : std::isnan(result));
            }
        }
        const double result = Rounder(format)(static_cast<double>(nan));
        EXPECT_TRUE(fixed ? result == format.max() : std::isnan(result));
    }
}
INSTANTIATE_TEST_SUITE_P(Formats, SixteenBits,
                         testing::Values("fp16", "bf16", "e6m9", "ue5m11b29", "ue4m12b11",
                                         "e4m11b11", "e2m13", "q4.12", "q16.0", "uq0.16", "uq3.13",
                                         "uq1.15"));

/// Any bit pattern: lanes of every width and the scalar agree, also where an array does not fill
/// its last vector.
TEST(Rounding, IsTheSameAtEveryWidth) {
    std::mt19937_64 random(7);
    for (const char* name : {"fp32", "fp16", "bf16", "e8m15", "e6m12", "ue6m14b50", "q5.13",
                             "q12.12", "uq2.16", "uq0.23"}) {
        const NumberFormat format = parse_format(name);
        const Rounder scalar(format);
        for (int trial = 0; trial < 20000; ++trial) {
            std::vector<float> values(static_cast<std::size_t>(1 + trial % 19));
            for (float& value : values) {
                const auto bits = static_cast<std::uint32_t>(random());
                std::memcpy(&value, &bits, sizeof value);
                value = trial % 2 == 0 ? value
                                       : std::ldexp(static_cast<float>(bits % 999983),
                                                    -static_cast<int>(random() % 40));
            }
            for (const RoundFunction round : round_variants()) {
                const std::vector<float> results = rounded(format, round, values);
                for (std::size_t i = 0; i < values.size(); ++i) {
                    const double expected = scalar(static_cast<double>(values[i]));
                    ASSERT_TRUE(static_cast<double>(results[i]) == expected ||
                                (std::isnan(results[i]) && std::isnan(expected)))
                        << name << " " << values[i] << " " << results[i] << " " << expected;
                }
            }
        }
    }
}

TEST(Rounding, HappensOnce) {
    // Rounded to a float first, this would be a tie and go down to 1.
    const double above_the_tie = 1 + std::pow(2.0, -11) + std::pow(2.0, -40);
    EXPECT_EQ(Rounder(parse_format("fp16"))(above_the_tie), 1 + std::pow(2.0, -10));
    EXPECT_EQ(Rounder(parse_format("fp16"))(static_cast<double>(static_cast<float>(above_the_tie))),
              1);
    EXPECT_EQ(Rounder(parse_format("q18.12"))(-100000.0 - 0.75 / 4096), -100000.0 - 1.0 / 4096);
}

TEST(Rounding, DoubleKeepsEverything) {
    const Rounder keep(parse_format("fp64"));
    for (const double x : {0.1, -1e300, 5e-324}) {
        EXPECT_EQ(keep(x), x);
    }
}

TEST(NumberFormat, HasTheNameItWasMadeFrom) {
    for (const char* name : {"fp64", "fp32", "fp16", "bf16", "e6m9", "ue5m11b29", "ue5m11", "q4.12",
                             "uq0.16", "q18.12", "uq3.17"}) {
        EXPECT_EQ(parse_format(name).name(), name);
    }
    EXPECT_EQ(parse_format("e5m10").name(), "fp16");
    EXPECT_EQ(parse_format("fp64").storage_bits(), 64);
    EXPECT_EQ(parse_format("ue5m11b29").storage_bits(), 16);
    EXPECT_EQ(parse_format("q18.12").storage_bits(), 30);
    EXPECT_EQ(parse_format("fp16").max(), 65504);
}

TEST(NumberFormat, RefusesWhatIsNoFormat) {
    for (const char* name :
         {"",   "fp8",   "e9m3",   "e1m3",      "e5",      "e5m0",   "e5m24",
          "em", "q",     "q4",     "q0.8",      "uq0.1",   "q20.13", "q4.12 ",
          "u",  "fp16x", "e5m10b", "e5m10b128", "e8m7b20", "q-1.4",  "uq99999999999.1"}) {
        try {
            parse_format(name);
            ADD_FAILURE() << name;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("'" + std::string(name) + "'"),
                      std::string::npos);
        }
    }
    EXPECT_THROW(LaneRounding{parse_format("fp64")}, InputError);
    EXPECT_THROW(LaneRounding{parse_format("q18.12")}, InputError);
}

} // namespace
} // namespace degs
