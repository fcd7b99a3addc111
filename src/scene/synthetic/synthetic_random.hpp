// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <random>

#include <glm/glm.hpp>

namespace degs {

/// exp and log from sums and products alone, because the last bit of those of the C
/// library differs between platforms. Relative error below 1e-14; `x` of exp in -600 ..
/// 600, of log positive and normal.
double portable_exp(double x);
double portable_log(double x);

/// Random numbers that are the same everywhere. The standard fixes the bits of the engine but not
/// its distributions, so this class maps them with sums, products and square roots.
class SyntheticRandom {
public:
    explicit SyntheticRandom(std::uint64_t seed) : engine_(seed) {}

    double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; } ///< [0, 1)
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    glm::dvec3 in_ball();                ///< radius 1
    glm::dvec3 direction();              ///< length 1
    glm::dvec2 on_circle();              ///< length 1
    std::array<float, 4> signed_units(); ///< 4 values in [-1, 1) of 16 bits from one draw

private:
    std::mt19937_64 engine_;
};

/// A distribution given by what was measured: values at 0, 10, 50, 90, 99 and 100 %, joined by
/// straight lines (of their logarithms if `logarithmic`).
class MeasuredDistribution {
public:
    enum class Axis { Linear, Logarithmic };
    MeasuredDistribution(Axis axis, const std::array<double, 6>& values);
    double sample(SyntheticRandom& random) const;
    /// Takes that power of every value of a logarithmic axis.
    void raise_to(double power);

private:
    Axis axis_;
    std::array<double, 6> values_; ///< logarithms if the axis is
};

} // namespace degs
