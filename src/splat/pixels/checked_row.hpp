// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "splat/frame/pixel_index.hpp"
#include "splat/pixels/blend_lanes.hpp"

namespace degs {

/// One row of a splat as test_function() checks it: the pixel n columns from the splat's nearest
/// one passes if A (n - centre)^2 + rest <= limit, every operation rounded to T.
template <class T>
struct CheckedRow {
    T centre, rest; ///< as in TestRow
    T a, inverse_a; ///< A and 1 / A, each rounded
    T limit;        ///< as in BlendRecord

    bool passes(int n) const {
        const T u = static_cast<T>(n) - centre;
        return a * u * u + rest <= limit;
    }

    /// The columns of `bounds` whose pixels pass, to the last rounding. They are neighbours,
    /// because the sum falls towards the centre and rises behind it, rounded or not; there may be
    /// none.
    ///
    /// The solved ends, centre -+ width, name them unless a pixel is so close to an end that
    /// rounding may decide. With e = epsilon of T: a sum up to the limit passes and one an ulp
    /// above it, 8 e, fails; that is at most 512 e of a room of kLeastRoom, and 256 e of the width.
    /// The other roundings (A, 1 / A, room, root, ends, u, its products) move an end by less than
    /// 8 e (|centre| + width + 1) together.
    PixelRange columns(const PixelRange& bounds) const {
        const T room = limit - rest;
        const T width = std::sqrt(room * inverse_a);
        const T left = centre - width;
        const T right = centre + width;
        const T first = std::ceil(left);
        const T last = std::floor(right);
        const T doubt = kDoubt * (std::abs(centre) + width + 1);
        const T middle = T(0.5); // between two pixels
        const T off_middle =
            std::max(std::abs(first - left - middle), std::abs(right - last - middle));
        if (room >= kLeastRoom && off_middle < middle - doubt) { // false if one is not a number
            return PixelRange{static_cast<int>(first), static_cast<int>(last)}.within(bounds);
        }
        return searched(bounds, first, last);
    }

private:
    static constexpr T kLeastRoom = T(0x1p-6);
    /// px per px; at the same time it keeps solved ends within 2^13 px of the splat.
    static constexpr T kDoubt = T(0x1p-14);
    static_assert(kDoubt >= 512 * std::numeric_limits<T>::epsilon() && kQLimit < 16);

    /// The pixel nearest to the centre decides whether there are any; the solved ends are then
    /// moved until the check agrees.
    [[gnu::noinline]] PixelRange searched(const PixelRange& bounds, T first, T last) const {
        const int low = bounds.first;
        const int high = bounds.last;
        if (!(rest <= limit) || !std::isfinite(centre) || bounds.empty()) {
            return {};
        }
        const auto column = [&](T x) { // clamped first: not every x is an int
            return x > static_cast<T>(low) ? x < static_cast<T>(high) ? static_cast<int>(x) : high
                                           : low;
        };
        const int nearest = std::clamp(column(std::nearbyint(centre)), low, high);
        if (!passes(nearest)) {
            return {};
        }
        int left = std::clamp(column(first), low, nearest);
        int right = std::clamp(column(last), nearest, high);
        for (; !passes(left); ++left) {
        }
        for (; left > low && passes(left - 1); --left) {
        }
        for (; !passes(right); --right) {
        }
        for (; right < high && passes(right + 1); ++right) {
        }
        return {left, right};
    }
};

} // namespace degs
