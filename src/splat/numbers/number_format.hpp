// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "config/config.hpp"

namespace degs {

/// The values that a register, a record field or a result of the data path can take.
///
/// A `Float` has the shape of IEEE 754. Stored exponent 0 holds subnormals, the highest one
/// infinities and NaN. Values are rounded to nearest, ties to even, and values that are too large
/// become infinite.
///
/// A `Fixed` value is a multiple of 2^-fraction_bits. Values that are too large saturate at the
/// largest value of either sign (the lowest two's complement code is not used), and NaN at the
/// positive one. An unsigned format has no sign bit, and negative values become 0.
struct NumberFormat {
    enum class Kind { Float, Fixed };
    Kind kind = Kind::Float;
    bool has_sign = true;
    int exponent_bits = 11; ///< Float: 2..8, or 11 for fp64
    int bias = 1023;        ///< Float: the exponent stored for values in [1, 2)
    int integer_bits = 0;   ///< Fixed: the sign included, as in Q notation
    int fraction_bits = 52; ///< Float: of the mantissa, as stored

    int sign_bits() const { return has_sign ? 1 : 0; }
    int storage_bits() const;
    /// Bits in storage without the sign.
    int magnitude_bits() const { return storage_bits() - sign_bits(); }
    /// Largest finite value.
    double max() const;
    /// Smallest positive value; of a fixed format the distance of all neighbours.
    double quantum() const;
    /// Float: smallest value with a full mantissa.
    double min_normal() const;
    bool is_fp64() const { return kind == Kind::Float && exponent_bits == 11; }
    /// All values are floats, and lanes of floats can be rounded to it: fixed formats up to 23 bits
    /// without the sign.
    bool fits_float() const;
    /// The name that parse_format reads.
    std::string name() const;
};

bool operator==(const NumberFormat& a, const NumberFormat& b);
inline bool operator!=(const NumberFormat& a, const NumberFormat& b) {
    return !(a == b);
}

/// Reads a name of one of these forms; a `u` in front means that there is no sign:
/// * "fp64", "fp32", "fp16", "bf16"
/// * "e6m9", "e5m10b29", "ue5m11b29": exponent bits, mantissa bits and bias (2^(E-1) - 1 if not
/// given)
/// * "q4.12", "uq0.16": integer bits (the sign included) and fraction bits
///
/// Throws InputError, which lists what is allowed.
NumberFormat parse_format(const std::string& name);
/// A key of a configuration that holds the name of a format.
void describe_format(ConfigVisitor& visitor, const char* key, NumberFormat& format,
                     const std::string& meaning);

/// Constants with which doubles, one or lanes of them (row_kernel.inc), are rounded to a format.
struct RoundingConstants {
    bool fixed = false;
    double min = 0, max = 0; ///< largest finite values of either sign
    double magic = 0;        ///< 1.5 * 2^52 units, of fixed formats and of subnormals
    // Patterns of doubles; `magnitude` keeps the sign bit if there are no negative values.
    std::uint64_t magnitude = 0, low = 0, range = 0, half_less_one = 0, keep = ~std::uint64_t{0};
    std::uint64_t odd = 0; ///< 1 if anything is cut off
    int shift = 0;

    RoundingConstants() = default; ///< to fp64: keeps everything
    explicit RoundingConstants(const NumberFormat& format);
};

/// Rounds doubles to a format; the constants are worked out once.
class Rounder {
public:
    Rounder() = default; ///< to fp64: keeps everything
    explicit Rounder(const NumberFormat& format) : to_(format) {}

    double operator()(double x) const {
        if (to_.fixed) { // adding and subtracting 1.5 * 2^52 units rounds to whole units
            const double y = (x + to_.magic) - to_.magic;
            return y >= to_.min && y <= to_.max ? y : outside(x);
        }
        // What lies between the smallest normal and the largest value: half a unit less one is
        // added to the pattern, and the last bit that is kept, before the rest is cut. With fp64
        // all patterns stay as they are.
        std::uint64_t bits = 0;
        std::memcpy(&bits, &x, sizeof bits);
        if ((bits & to_.magnitude) - to_.low > to_.range) {
            return beside(x);
        }
        bits += to_.half_less_one + ((bits >> to_.shift) & to_.odd);
        bits &= to_.keep;
        double y = 0;
        std::memcpy(&y, &bits, sizeof y);
        return y;
    }

private:
    double beside(double x) const;
    double outside(double x) const;

    RoundingConstants to_;
};

/// Constants of the integer rounding of float lanes (rounding.inc): bit patterns without their sign
/// are compared with them and cut by them.
struct LaneRounding {
    std::int32_t shift = 0;         ///< mantissa bits that are cut off
    std::int32_t half_less_one = 0; ///< added before the cut, and so is the last bit that is kept
    std::int32_t odd = 0;           ///< 1 if anything is cut off
    std::int32_t keep = 0x7FFFFFFF; ///< mask of what is left
    std::int32_t min_normal = 0; ///< what lies below is rounded to a unit, by adding `magic` to it
    std::int32_t max = 0x7F800000; ///< what lies above becomes `over`
    std::int32_t over = 0x7F800000;
    std::int32_t nan = 0x7FC00000;
    std::int32_t sign = INT32_MIN; ///< mask of the sign bit
    float magic = 0; ///< 2^23 units; 1.5 times as much in fixed formats that lanes can sum with it
    float low = 0, high = 0; ///< Fixed: where values saturate

    LaneRounding() = default; ///< to fp32: keeps everything
    /// Throws InputError unless format.fits_float().
    explicit LaneRounding(const NumberFormat& format);
};

/// Rounds an array in place, every value once.
using RoundFunction = void (*)(const LaneRounding& rounding, float* values, std::size_t count);
/// All variants this build has, narrow first, which give the same bits; those the machine cannot
/// run are left out. For tests.
std::vector<RoundFunction> round_variants();

} // namespace degs
