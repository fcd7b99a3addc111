// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "splat/numbers/projection_numbers.hpp"

namespace degs {

/// SH coefficients as memory holds them: rounded to ProjectionNumbers::sh_dc and sh_rest.
class StoredSh {
public:
    /// Coefficients of degree 3, three channels each.
    using Values = std::array<float, 48>;

    explicit StoredSh(const ProjectionNumbers& numbers)
        : as_they_are_(numbers.sh_dc.is_fp64() && numbers.sh_rest.is_fp64()), dc_(numbers.sh_dc),
          rest_(numbers.sh_rest) {}

    /// The 3 (degree + 1)^2 coefficients at `given`, rounded into `room`, or `given` itself if
    /// nothing is to be rounded. Degree 0..3.
    const float* read(const float* given, int degree, Values& room) const {
        if (as_they_are_) {
            return given;
        }
        const int count = 3 * (degree + 1) * (degree + 1);
        for (int i = 0; i < count; ++i) {
            room[i] = static_cast<float>(i < 3 ? dc_(given[i]) : rest_(given[i]));
        }
        return room.data();
    }

private:
    bool as_they_are_;
    Rounder dc_, rest_;
};

} // namespace degs
