// SPDX-License-Identifier: Apache-2.0
#include "scene/synthetic/synthetic_random.hpp"

#include <cmath>

namespace degs {
namespace {

constexpr double kLn2 = 0.69314718055994530942;
constexpr std::array<double, 6> kShares{0.0, 0.1, 0.5, 0.9, 0.99, 1.0};

} // namespace

double portable_exp(double x) {
    const double exponent = std::floor(x / kLn2 + 0.5);
    const double r = x - exponent * kLn2; // |r| <= ln 2 / 2
    double sum = 1;
    for (int i = 13; i > 0; --i) { // Taylor, Horner form; the next term is below 1e-17
        sum = 1 + sum * r / i;
    }
    return std::ldexp(sum, static_cast<int>(exponent));
}

double portable_log(double x) {
    int exponent = 0;
    const double mantissa = std::frexp(x, &exponent); // 0.5 .. 1
    double y = mantissa - 1;
    for (int i = 0; i < 5; ++i) { // Halley's iteration on exp(y) = mantissa, cubic
        const double e = portable_exp(y);
        y += 2 * (mantissa - e) / (mantissa + e);
    }
    return y + exponent * kLn2;
}

glm::dvec3 SyntheticRandom::in_ball() {
    while (true) {
        const double x = uniform(-1, 1); // in this order: arguments of a call have none
        const double y = uniform(-1, 1);
        const double z = uniform(-1, 1);
        if (x * x + y * y + z * z <= 1) {
            return {x, y, z};
        }
    }
}

glm::dvec3 SyntheticRandom::direction() {
    while (true) {
        const glm::dvec3 v = in_ball();
        const double squared = glm::dot(v, v);
        if (squared > 1e-6) {
            return v / std::sqrt(squared);
        }
    }
}

glm::dvec2 SyntheticRandom::on_circle() {
    while (true) {
        const double x = uniform(-1, 1);
        const double y = uniform(-1, 1);
        const double squared = x * x + y * y;
        if (squared > 1e-6 && squared <= 1) {
            return glm::dvec2(x, y) / std::sqrt(squared);
        }
    }
}

std::array<float, 4> SyntheticRandom::signed_units() {
    const std::uint64_t bits = engine_();
    std::array<float, 4> values{};
    for (unsigned i = 0; i < 4; ++i) {
        values[i] = static_cast<float>((bits >> (16 * i)) & 0xFFFFU) / 32768.0F - 1.0F;
    }
    return values;
}

MeasuredDistribution::MeasuredDistribution(Axis axis, const std::array<double, 6>& values)
    : axis_(axis), values_(values) {
    if (axis == Axis::Logarithmic) {
        for (double& value : values_) {
            value = portable_log(value);
        }
    }
}

void MeasuredDistribution::raise_to(double power) {
    for (double& value : values_) {
        value *= power;
    }
}

double MeasuredDistribution::sample(SyntheticRandom& random) const {
    const double u = random.uniform();
    std::size_t i = 0;
    while (u >= kShares[i + 1]) { // u < 1 ends it
        ++i;
    }
    const double part = (u - kShares[i]) / (kShares[i + 1] - kShares[i]);
    const double value = values_[i] + part * (values_[i + 1] - values_[i]);
    return axis_ == Axis::Logarithmic ? portable_exp(value) : value;
}

} // namespace degs
