// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "splat/model/lens.hpp"
#include "splat/numbers/rounded.hpp"

namespace degs {

/// The map of a lens in the arithmetic of `Numbers`: coefficients are rounded once, then every
/// operation. It does not test for folds.
template <class Numbers>
class LensMap {
public:
    using Scalar = typename Numbers::Scalar;

    LensMap(const Numbers& numbers, const Lens& lens)
        : kind_(lens.coefficients().kind), one_(numbers(1.0)), two_(numbers(2.0)),
          zero_(numbers(0.0)), radial_(rounded(numbers, lens.coefficients().radial)),
          denominator_{numbers(lens.coefficients().denominator[0]),
                       numbers(lens.coefficients().denominator[1]),
                       numbers(lens.coefficients().denominator[2]), zero_},
          p1_(numbers(lens.coefficients().tangential[0])),
          p2_(numbers(lens.coefficients().tangential[1])) {}

    Slopes<Scalar> operator()(const Slopes<Scalar>& s) const {
        switch (kind_) {
        case LensCoefficients::Kind::OpenCv:
            return open_cv(s);
        case LensCoefficients::Kind::Fisheye:
            return fisheye(s);
        default:
            return s;
        }
    }

private:
    struct Four {
        Scalar a, b, c, d;
    };
    static Four rounded(const Numbers& n, const std::array<double, 4>& k) {
        return {n(k[0]), n(k[1]), n(k[2]), n(k[3])};
    }
    /// 1 + a q + b q^2 + c q^3 + d q^4
    Scalar polynomial(const Four& k, const Scalar& q) const {
        return one_ + q * (k.a + q * (k.b + q * (k.c + q * k.d)));
    }
    Slopes<Scalar> open_cv(const Slopes<Scalar>& s) const {
        const Scalar xx = s.x * s.x, yy = s.y * s.y, xy = two_ * (s.x * s.y);
        const Scalar q = xx + yy;
        const Scalar scale = polynomial(radial_, q) / polynomial(denominator_, q);
        return {s.x * scale + (p1_ * xy + p2_ * (q + two_ * xx)),
                s.y * scale + (p2_ * xy + p1_ * (q + two_ * yy))};
    }
    Slopes<Scalar> fisheye(const Slopes<Scalar>& s) const {
        const Scalar slope = root_of(s.x * s.x + s.y * s.y);
        if (!(slope > zero_)) {
            return s; // on the axis; NaN stays NaN
        }
        const Scalar angle = arctangent_of(slope);
        const Scalar scale = angle * polynomial(radial_, angle * angle) / slope;
        return {s.x * scale, s.y * scale};
    }

    LensCoefficients::Kind kind_;
    Scalar one_, two_, zero_;
    Four radial_, denominator_;
    Scalar p1_, p2_;
};

} // namespace degs
