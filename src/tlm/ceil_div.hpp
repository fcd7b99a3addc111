// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

namespace degs {

/// a / b rounded up, of integers a >= 0 and b > 0.
template <class A, class B>
constexpr std::common_type_t<A, B> ceil_div(A a, B b) {
    return (a + b - 1) / b;
}

} // namespace degs
