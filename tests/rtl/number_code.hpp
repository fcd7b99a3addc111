// SPDX-License-Identifier: Apache-2.0
// Values of a number format as the bits of a register, and back.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "splat/numbers/number_format.hpp"

namespace degs::rtl_test {

inline std::uint64_t low_bits(int count) {
    return (std::uint64_t{1} << count) - 1;
}

/// Gives a port of the RTL, of whatever width, a code.
template <class Port>
void put(Port& port, std::uint64_t code) {
    port = static_cast<Port>(code);
}

/// The code of a value of the format. A zero has no sign, and there is one NaN.
inline std::uint64_t code_of(const NumberFormat& format, double value) {
    if (format.kind == NumberFormat::Kind::Fixed) {
        const double units = std::ldexp(value, format.fraction_bits);
        return static_cast<std::uint64_t>(std::llround(units)) & low_bits(format.storage_bits());
    }
    const std::uint64_t last = low_bits(format.exponent_bits) << format.fraction_bits;
    if (std::isnan(value)) {
        return last | std::uint64_t{1} << (format.fraction_bits - 1);
    }
    const std::uint64_t sign = std::uint64_t{value < 0 ? 1U : 0U} << format.magnitude_bits();
    if (std::isinf(value)) {
        return sign | last;
    }
    const double size = std::abs(value);
    int exponent = 0;
    std::frexp(size, &exponent);
    const int stored = size == 0 ? 0 : std::max(exponent - 1 + format.bias, 0);
    const int lowest = std::max(stored, 1) - format.bias - format.fraction_bits;
    const auto mantissa = static_cast<std::uint64_t>(std::ldexp(size, -lowest));
    // The leading 1 of a normal number adds 1 to the exponent below.
    const std::uint64_t below = stored > 0 ? stored - 1 : 0;
    return sign | ((below << format.fraction_bits) + mantissa);
}

/// The value of a code.
inline double value_of_code(const NumberFormat& format, std::uint64_t code) {
    const int bits = format.storage_bits();
    if (format.kind == NumberFormat::Kind::Fixed) {
        const bool negative = format.has_sign && (code >> (bits - 1) & 1U) != 0;
        const double units = static_cast<double>(code) - (negative ? std::ldexp(1.0, bits) : 0.0);
        return std::ldexp(units, -format.fraction_bits);
    }
    const std::uint64_t mantissa = code & low_bits(format.fraction_bits);
    const auto stored =
        static_cast<int>(code >> format.fraction_bits & low_bits(format.exponent_bits));
    const double sign = format.has_sign && (code >> (bits - 1) & 1U) != 0 ? -1 : 1;
    if (stored == (1 << format.exponent_bits) - 1) {
        return mantissa != 0 ? std::numeric_limits<double>::quiet_NaN()
                             : sign * std::numeric_limits<double>::infinity();
    }
    const std::uint64_t whole =
        stored > 0 ? mantissa + low_bits(format.fraction_bits) + 1 : mantissa;
    return sign * std::ldexp(static_cast<double>(whole),
                             std::max(stored, 1) - format.bias - format.fraction_bits);
}

} // namespace degs::rtl_test
