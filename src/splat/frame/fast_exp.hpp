// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace degs {

/// exp(x) for x <= 0, within 1e-4 of its value: a polynomial of the fraction and the bits of the
/// exponent, so that the compiler turns a loop over pixels into vector instructions.
inline float fast_exp(float x) {
    const float power = std::max(x * 1.44269504F, -126.0F);
    const auto whole = static_cast<std::int32_t>(power - 0.999999F);
    const float rest = power - static_cast<float>(whole); // 0 .. 1
    const float mantissa = 1.0F + rest * (0.69583354F + rest * (0.22606716F + rest * 0.07809929F));
    std::int32_t bits = 0;
    std::memcpy(&bits, &mantissa, sizeof bits);
    bits += whole * (std::int32_t{1} << 23);
    float result = 0;
    std::memcpy(&result, &bits, sizeof result);
    return result;
}

} // namespace degs
