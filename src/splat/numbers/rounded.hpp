// SPDX-License-Identifier: Apache-2.0
// Scalars for arithmetic that is written once and computed in any number format.
#pragma once

#include <cmath>

#include "splat/numbers/number_format.hpp"

namespace degs {

class Rounded;

/// Makes values of a format out of doubles, rounded once. A value that leaves a fixed format
/// becomes infinite, as in a float, so that an overflow on the way is visible in the result.
class RoundedNumbers {
public:
    using Scalar = Rounded;
    explicit RoundedNumbers(const NumberFormat& format)
        : rounder_(format),
          max_(format.kind == NumberFormat::Kind::Fixed ? format.max() : INFINITY) {}
    Rounded operator()(double x) const;
    double round(double x) const {
        // A zero keeps the sign of what it was rounded from, and NaN stays NaN.
        return std::abs(x) <= max_ ? std::copysign(rounder_(x), x) : x * INFINITY;
    }

private:
    Rounder rounder_;
    double max_;
};

/// A value of a format; the result of every operation is rounded once to it. Products of fixed
/// formats of more than 26 bits are rounded twice, to double first.
class Rounded {
public:
    Rounded(double x, const RoundedNumbers& numbers) : value_(numbers.round(x)), to_(&numbers) {}
    double value() const { return value_; }
    const RoundedNumbers& numbers() const { return *to_; }

    friend Rounded operator+(Rounded a, Rounded b) { return {a.value_ + b.value_, *a.to_}; }
    friend Rounded operator-(Rounded a, Rounded b) { return {a.value_ - b.value_, *a.to_}; }
    friend Rounded operator*(Rounded a, Rounded b) { return {a.value_ * b.value_, *a.to_}; }
    friend Rounded operator/(Rounded a, Rounded b) { return {a.value_ / b.value_, *a.to_}; }
    friend bool operator<(Rounded a, Rounded b) { return a.value_ < b.value_; }
    friend bool operator>(Rounded a, Rounded b) { return a.value_ > b.value_; }
    friend bool operator>=(Rounded a, Rounded b) { return a.value_ >= b.value_; }

private:
    double value_;
    const RoundedNumbers* to_;
};

inline Rounded RoundedNumbers::operator()(double x) const {
    return {x, *this};
}

/// fp64 and fp32: the machine's own operations, which round like Rounded does.
template <class Float>
struct MachineNumbers {
    using Scalar = Float;
    Float operator()(double x) const { return static_cast<Float>(x); }
};

inline double value_of(double x) {
    return x;
}
inline double value_of(float x) {
    return static_cast<double>(x);
}
inline double value_of(Rounded x) {
    return x.value();
}

// Functions are rounded once as well, from double, because logf differs between libraries.
inline double root_of(double x) {
    return std::sqrt(x);
}
inline float root_of(float x) {
    return std::sqrt(x);
}
inline Rounded root_of(Rounded x) {
    return {std::sqrt(x.value()), x.numbers()};
}
inline double log_of(double x) {
    return std::log(x);
}
inline float log_of(float x) {
    return static_cast<float>(std::log(static_cast<double>(x)));
}
inline Rounded log_of(Rounded x) {
    return {std::log(x.value()), x.numbers()};
}
inline double arctangent_of(double x) {
    return std::atan(x);
}
inline float arctangent_of(float x) {
    return static_cast<float>(std::atan(static_cast<double>(x)));
}
inline Rounded arctangent_of(Rounded x) {
    return {std::atan(x.value()), x.numbers()};
}

} // namespace degs
