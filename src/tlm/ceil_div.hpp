// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace degs {

/// a / b rounded up, of integers a >= 0 and b > 0.
template <class Integer>
constexpr Integer ceil_div(Integer a, Integer b) {
    return (a + b - 1) / b;
}

} // namespace degs
