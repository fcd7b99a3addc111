// SPDX-License-Identifier: Apache-2.0
#include "splat/model/lens.hpp"

#include <algorithm>
#include <cmath>

#include "base/ratio.hpp"
#include "splat/model/lens_map.hpp"

namespace degs {
namespace {

using Kind = LensCoefficients::Kind;

/// A polynomial a + b q + c q^2 ... and its derivative at one place.
struct Value {
    double value = 0, slope = 0;
};

template <std::size_t kCount>
Value one_plus(const std::array<double, kCount>& k, double q) {
    Value sum;
    for (std::size_t i = kCount; i-- > 0;) {
        sum.slope = sum.slope * q + real_of(i + 1) * k[i];
        sum.value = (sum.value + k[i]) * q;
    }
    sum.value += 1;
    return sum;
}

template <std::size_t kCount>
bool all_finite(const std::array<double, kCount>& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

template <std::size_t kCount>
bool all_zero(const std::array<double, kCount>& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return v == 0; });
}

/// The last place in (good, bad] up to which `holds`, which is true at `good` and false at `bad`.
template <class Holds>
double last_place(double good, double bad, Holds&& holds) {
    for (double middle = 0.5 * (good + bad); middle > good && middle < bad;
         middle = 0.5 * (good + bad)) {
        (holds(middle) ? good : bad) = middle;
    }
    return good;
}

} // namespace

bool LensCoefficients::operator==(const LensCoefficients& other) const {
    return kind == other.kind && radial == other.radial && denominator == other.denominator &&
           tangential == other.tangential;
}

Lens::Lens(const LensCoefficients& coefficients) : coefficients_(coefficients) {
    const LensCoefficients& c = coefficients_;
    if (c.kind == Kind::OpenCv && all_zero(c.radial) && all_zero(c.denominator) &&
        all_zero(c.tangential)) {
        coefficients_.kind = Kind::Pinhole;
    }
    if (is_pinhole()) {
        return;
    }
    constexpr int kSteps = 4096;
    const double most = std::atan(kMostSlope);
    double good = 0;
    for (int i = 1; i <= kSteps; ++i) {
        const double slope = std::tan(most * i / kSteps);
        if (!(growth_at(slope) > 0)) {
            fold_slope_ = last_place(good, slope, [&](double r) { return growth_at(r) > 0; });
            return;
        }
        good = slope;
    }
}

const char* Lens::name() const {
    switch (coefficients_.kind) {
    case Kind::OpenCv:
        return "OpenCV";
    case Kind::Fisheye:
        return "OpenCV fisheye";
    default:
        return "pinhole";
    }
}

bool Lens::is_sound() const {
    const LensCoefficients& c = coefficients_;
    const bool others = c.kind == Kind::OpenCv ||
                        (all_zero(c.denominator) && all_zero(c.tangential) &&
                         (c.kind == Kind::Fisheye || (is_pinhole() && all_zero(c.radial))));
    return others && all_finite(c.radial) && all_finite(c.denominator) && all_finite(c.tangential);
}

double Lens::growth_at(double slope) const {
    const LensCoefficients& c = coefficients_;
    if (c.kind == Kind::Fisheye) {
        const double angle = std::atan(slope);
        const Value sum = one_plus(c.radial, angle * angle);
        return sum.value + 2 * angle * angle * sum.slope;
    }
    const double q = slope * slope;
    const Value over = one_plus(c.radial, q), under = one_plus(c.denominator, q);
    if (!(under.value > 0)) {
        return 0;
    }
    const double scale = over.value / under.value; // f(r)/r, and its derivative by q
    const double change = (over.slope - scale * under.slope) / under.value;
    const double along = scale + 2 * q * change; // f'(r)
    return std::isfinite(along)
               ? std::min(scale, along) - 6 * slope * std::hypot(c.tangential[0], c.tangential[1])
               : 0;
}

double Lens::radius_at(double slope) const {
    const LensCoefficients& c = coefficients_;
    switch (c.kind) {
    case Kind::OpenCv: {
        const double q = slope * slope;
        return slope * one_plus(c.radial, q).value / one_plus(c.denominator, q).value;
    }
    case Kind::Fisheye: {
        const double angle = std::atan(slope);
        return angle * one_plus(c.radial, angle * angle).value;
    }
    default:
        return slope;
    }
}

double Lens::slope_at(double radius) const {
    return radius_at(fold_slope_) > radius
               ? last_place(0, fold_slope_, [&](double r) { return radius_at(r) <= radius; })
               : fold_slope_;
}

glm::dvec2 Lens::bent(const glm::dvec2& slopes) const {
    const Slopes<double> bent = LensMap(MachineNumbers<double>(), *this)({slopes.x, slopes.y});
    return {bent.x, bent.y};
}

} // namespace degs
