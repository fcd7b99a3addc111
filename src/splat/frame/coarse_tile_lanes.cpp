// SPDX-License-Identifier: Apache-2.0
// What a CoarseTile does for four rows, or for four samples of a row, at a time. The steps of each
// are those of a single one, so that results do not depend on the instruction set.
#include <cstdint>

#include <hwy/highway.h>

#include "splat/frame/coarse_tile.hpp"
#include "splat/frame/fast_exp.hpp"
#include "splat/frame/pixel_rules.hpp"

HWY_BEFORE_NAMESPACE();
namespace degs {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kLanes = CoarseTile::kLanes;
constexpr hn::FixedTag<float, kLanes> kFloats;
constexpr hn::FixedTag<std::int32_t, kLanes> kIntegers;
using Floats = hn::Vec<decltype(kFloats)>;
using Mask = hn::Mask<decltype(kFloats)>;

HWY_INLINE Floats all(float value) {
    return hn::Set(kFloats, value);
}
/// Bit i of the result: lane i.
HWY_INLINE std::uint32_t bits(const Mask& lanes) {
    std::uint8_t bits[8];
    hn::StoreMaskBits(kFloats, lanes, bits);
    return bits[0];
}

/// fast_exp().
HWY_INLINE Floats fast_exponential(const Floats& x) {
    const Floats product = x * all(1.44269504F);
    const Floats power = hn::IfThenElse(product < all(-126.0F), all(-126.0F), product);
    const Floats whole = hn::Trunc(power - all(0.999999F));
    const Floats rest = power - whole;
    const Floats mantissa =
        all(1.0F) + rest * (all(0.69583354F) + rest * (all(0.22606716F) + rest * all(0.07809929F)));
    const auto exponent = hn::BitCast(kIntegers, whole + all(0x1.8p23F)); // in its lowest bits
    return hn::BitCast(kFloats, hn::BitCast(kIntegers, mantissa) + hn::ShiftLeft<23>(exponent));
}

} // namespace HWY_NAMESPACE

using namespace HWY_NAMESPACE;

void CoarseTile::solve_rows() {
    const Floats least = all(static_cast<float>(columns_.first));
    const Floats most = all(static_cast<float>(columns_.last));
    const Floats beyond = all(static_cast<float>(options_.delta));
    CoarseSpan* span = spans_.data();
    for (int r = first_sampled(); r < end_sampled(); r += kLanes) {
        const Floats dy = hn::LoadU(kFloats, &row_values_[r]) - all(mu_y_);
        const Floats rest = all(threshold_) - dy * dy * all(inverse_c_);
        const Floats centre = all(mu_x_) + all(slope_) * dy;
        const Floats reach = hn::Sqrt(rest * all(det_over_c_));
        const Floats low = centre - reach, high = centre + reach;
        Floats left = options_.outward ? hn::Floor(low) - beyond : hn::Ceil(low);
        Floats right = options_.outward ? hn::Ceil(high) + beyond : hn::Floor(high);
        left = hn::IfThenElse(left < least, least, left);
        right = hn::IfThenElse(most < right, most, right);
        std::int32_t first[kLanes], last[kLanes];
        hn::StoreU(hn::ConvertTo(kIntegers, left), kIntegers, first);
        hn::StoreU(hn::ConvertTo(kIntegers, right), kIntegers, last);
        std::uint32_t met = bits(hn::And(rest >= all(0.0F), left <= right));
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
    for (const CoarseSpan& span : spans()) {
        const Samples in = samples_in(span);
        float* const row = transmittance_of(span.row);
        const float dy = static_cast<float>(span.row) - mu_y_;
        const Floats q_row = all(dy * dy * inverse_c_);
        const Floats start = all(static_cast<float>(phase_of(span.row)) - (mu_x_ + slope_ * dy));
        const Floats first = all(static_cast<float>(in.first));
        const Floats last = all(static_cast<float>(in.last));
        for (int i = in.first / kLanes * kLanes; i <= in.last; i += kLanes) {
            const Floats sample = hn::Iota(kFloats, 0.0F) + all(static_cast<float>(i));
            const Floats before = hn::LoadU(kFloats, row + i);
            const Floats dx = start + sample * all(kApart);
            const Floats q = all(conic_a_) * dx * dx + q_row;
            const Mask in_span = hn::And(sample >= first, sample <= last);
            const Mask inside =
                hn::And(in_span, hn::And(before != all(0.0F), q <= all(threshold_)));
            const std::uint32_t tested = bits(inside);
            if (tested == 0) {
                continue;
            }
            const Floats unlimited = all(opacity_) * fast_exponential(all(-0.5F) * q);
            const Floats limit = all(static_cast<float>(kAlphaMax));
            const Floats alpha = hn::IfThenElse(unlimited < limit, unlimited, limit);
            const Floats rest = before * (all(1.0F) - alpha);
            const Mask alive = rest >= all(static_cast<float>(kStopTransmittance));
            const Floats after = hn::IfThenElseZero(alive, rest);
            hn::StoreU(hn::IfThenElse(inside, after, before), kFloats, row + i);
            std::uint32_t ended = tested & ~bits(alive);
            blended_ += __builtin_popcount(tested ^ ended);
            for (; ended != 0; ended &= ended - 1) {
                end_sample(span.row, phase_of(span.row) + (i + __builtin_ctz(ended)) * kApart);
            }
        }
    }
}

} // namespace degs
HWY_AFTER_NAMESPACE();
