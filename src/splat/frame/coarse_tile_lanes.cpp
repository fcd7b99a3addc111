// SPDX-License-Identifier: Apache-2.0
// What a CoarseTile does for four rows, or for four samples of a row, at a time. The steps of each
// are those of a single one, so that results do not depend on the instruction set.
#include <cmath>
#include <cstdint>
#include <cstring>

#ifdef __SSE4_1__
#include <smmintrin.h>
#endif

#include "splat/frame/coarse_tile.hpp"
#include "splat/frame/fast_exp.hpp"
#include "splat/frame/pixel_rules.hpp"

namespace degs {

namespace {

constexpr int kLanes = CoarseTile::kLanes;
#include "splat/numbers/lanes.inc"

FloatLanes all(float value) {
    return FloatLanes{} + value;
}
FloatLanes load(const float* from) {
    FloatLanes lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}
FloatLanes floats(const IntLanes& lanes) {
    return __builtin_convertvector(lanes, FloatLanes);
}
IntLanes integers(const FloatLanes& lanes) {
    return __builtin_convertvector(lanes, IntLanes);
}

#ifdef __SSE4_1__
FloatLanes square_root(const FloatLanes& x) {
    return same_bits<FloatLanes>(_mm_sqrt_ps(same_bits<__m128>(x)));
}
FloatLanes up(const FloatLanes& x) {
    return same_bits<FloatLanes>(_mm_ceil_ps(same_bits<__m128>(x)));
}
FloatLanes down(const FloatLanes& x) {
    return same_bits<FloatLanes>(_mm_floor_ps(same_bits<__m128>(x)));
}
/// Bit i of the result is the sign of lane i.
std::uint32_t bits(const IntLanes& lanes) {
    return static_cast<std::uint32_t>(_mm_movemask_ps(same_bits<__m128>(lanes)));
}
#else
template <class Function>
FloatLanes each(const FloatLanes& x, const Function& function) {
    FloatLanes result;
    for (int i = 0; i < kLanes; ++i) {
        result[i] = function(x[i]);
    }
    return result;
}
FloatLanes square_root(const FloatLanes& x) {
    return each(x, [](float value) { return std::sqrt(value); });
}
FloatLanes up(const FloatLanes& x) {
    return each(x, [](float value) { return std::ceil(value); });
}
FloatLanes down(const FloatLanes& x) {
    return each(x, [](float value) { return std::floor(value); });
}
/// Bit i of the result is the sign of lane i.
std::uint32_t bits(const IntLanes& lanes) {
    return lane_mask(lanes);
}
#endif

/// fast_exp().
FloatLanes exponential(const FloatLanes& x) {
    const FloatLanes product = x * 1.44269504F;
    const FloatLanes power = product < -126.0F ? all(-126.0F) : product;
    const IntLanes whole = integers(power - 0.999999F);
    const FloatLanes rest = power - floats(whole);
    const FloatLanes mantissa =
        1.0F + rest * (0.69583354F + rest * (0.22606716F + rest * 0.07809929F));
    return same_bits<FloatLanes>(same_bits<IntLanes>(mantissa) + whole * (std::int32_t{1} << 23));
}

} // namespace

void CoarseTile::solve_rows() {
    const FloatLanes least = all(static_cast<float>(columns_.first));
    const FloatLanes most = all(static_cast<float>(columns_.last));
    const FloatLanes beyond = all(static_cast<float>(options_.delta));
    CoarseSpan* span = spans_.data();
    for (int r = first_sampled(); r < end_sampled(); r += kLanes) {
        const FloatLanes dy = load(&row_values_[r]) - mu_y_;
        const FloatLanes rest = threshold_ - dy * dy * inverse_c_;
        const FloatLanes centre = mu_x_ + slope_ * dy;
        const FloatLanes reach = square_root(rest * det_over_c_);
        const FloatLanes low = centre - reach, high = centre + reach;
        FloatLanes left = options_.outward ? down(low) - beyond : up(low);
        FloatLanes right = options_.outward ? up(high) + beyond : down(high);
        left = left < least ? least : left;
        right = most < right ? most : right;
        const IntLanes first = integers(left), last = integers(right);
        std::uint32_t met = bits((rest >= 0.0F) & (left <= right));
        if (end_sampled() - r < kLanes) {
            met &= (1U << (end_sampled() - r)) - 1;
        }
        for (; met != 0; met &= met - 1) {
            const int lane = __builtin_ctz(met);
            *span++ = {rows_[r + lane], first[lane], last[lane]};
        }
    }
    span_count_ = static_cast<std::size_t>(span - spans_.data());
}

void CoarseTile::blend() {
    const IntLanes lane = counting<IntLanes>();
    for (const CoarseSpan& span : spans()) {
        const Samples in = samples_in(span);
        float* const row = transmittance_of(span.row);
        const float dy = static_cast<float>(span.row) - mu_y_;
        const float q_row = dy * dy * inverse_c_;
        const float start = static_cast<float>(phase_of(span.row)) - (mu_x_ + slope_ * dy);
        for (int i = in.first / kLanes * kLanes; i <= in.last; i += kLanes) {
            const IntLanes sample = lane + i;
            const FloatLanes before = load(row + i);
            const FloatLanes dx = start + floats(sample * kApart);
            const FloatLanes q = conic_a_ * dx * dx + q_row;
            const IntLanes inside =
                (before != 0.0F) & (q <= threshold_) & (sample >= in.first) & (sample <= in.last);
            const std::uint32_t tested = bits(inside);
            if (tested == 0) {
                continue;
            }
            const FloatLanes unlimited = opacity_ * exponential(-0.5F * q);
            const FloatLanes limit = all(static_cast<float>(kAlphaMax));
            const FloatLanes alpha = unlimited < limit ? unlimited : limit;
            const FloatLanes rest = before * (1.0F - alpha);
            const IntLanes alive = rest >= static_cast<float>(kStopTransmittance);
            const FloatLanes after = chosen(inside, chosen(alive, rest, FloatLanes{}), before);
            std::memcpy(row + i, &after, sizeof after);
            std::uint32_t ended = tested & ~bits(alive);
            blended_ += __builtin_popcount(tested ^ ended);
            for (; ended != 0; ended &= ended - 1) {
                end_sample(span.row, phase_of(span.row) + (i + __builtin_ctz(ended)) * kApart);
            }
        }
    }
}

} // namespace degs
