// SPDX-License-Identifier: Apache-2.0
// The arithmetic behind evaluate_sh(), for any kind of scalar.
#pragma once

#include "splat/model/spherical_harmonics.hpp"

namespace degs {

/// Works out Y_k of one degree after the other, and nothing of higher degrees.
template <class Numbers>
struct ShBasis {
    using Scalar = typename Numbers::Scalar;
    using Values = std::array<Scalar, kMaxShCoefficients>;

    ShBasis(const Numbers& numbers, int most_degree, const Vector3<Scalar>& direction)
        : n(numbers), degree(most_degree), x(direction.x), y(direction.y), z(direction.z),
          xx(degree < 2 ? x : x * x), yy(degree < 2 ? y : y * y), zz(degree < 2 ? z : z * z) {}

    Values values() const {
        const Scalar none = n(0.0);
        Values out{{n(kShY0), none, none, none, none, none, none, none, none, none, none, none,
                    none, none, none, none}};
        if (degree >= 1) {
            fill_degree_1(out);
        }
        if (degree >= 2) {
            fill_degree_2(out);
        }
        if (degree >= 3) {
            fill_degree_3(out);
        }
        return out;
    }
    void fill_degree_1(Values& out) const {
        constexpr double kY1 = 0.4886025119029199; // sqrt(3 / (4 pi))
        out[1] = n(-kY1) * y;
        out[2] = n(kY1) * z;
        out[3] = n(-kY1) * x;
    }
    void fill_degree_2(Values& out) const {
        out[4] = n(1.0925484305920792) * x * y;
        out[5] = n(-1.0925484305920792) * y * z;
        out[6] = n(0.31539156525252005) * (n(2) * zz - xx - yy);
        out[7] = n(-1.0925484305920792) * x * z;
        out[8] = n(0.5462742152960396) * (xx - yy);
    }
    void fill_degree_3(Values& out) const {
        out[9] = n(-0.5900435899266435) * y * (n(3) * xx - yy);
        out[10] = n(2.890611442640554) * x * y * z;
        out[11] = n(-0.4570457994644658) * y * (n(4) * zz - xx - yy);
        out[12] = n(0.3731763325901154) * z * (n(2) * zz - n(3) * xx - n(3) * yy);
        out[13] = n(-0.4570457994644658) * x * (n(4) * zz - xx - yy);
        out[14] = n(1.445305721320277) * z * (xx - yy);
        out[15] = n(-0.5900435899266435) * x * (xx - n(3) * yy);
    }

    const Numbers& n;
    int degree;
    Scalar x, y, z;
    Scalar xx, yy, zz; ///< squares, from degree 2 on
};

template <class Numbers>
Vector3<typename Numbers::Scalar> evaluate_sh(const Numbers& numbers, int degree,
                                              const float* coefficients,
                                              const Vector3<typename Numbers::Scalar>& direction) {
    const auto basis = ShBasis<Numbers>(numbers, degree, direction).values();
    const int count = (degree + 1) * (degree + 1);
    Vector3<typename Numbers::Scalar> sum = vector_in(numbers, glm::dvec3(0.0));
    const float* rgb = coefficients;
    for (int k = 0; k < count; ++k, rgb += 3) {
        const auto& y = basis[k];
        sum = {sum.x + y * numbers(double{rgb[0]}), sum.y + y * numbers(double{rgb[1]}),
               sum.z + y * numbers(double{rgb[2]})};
    }
    return sum;
}

} // namespace degs
