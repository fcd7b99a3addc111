// SPDX-License-Identifier: Apache-2.0
#include "splat/numbers/number_format.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "degs/error.hpp"

namespace degs {
namespace {

NumberFormat float_format(int exponent_bits, int mantissa_bits, int bias, bool has_sign) {
    NumberFormat format;
    format.has_sign = has_sign;
    format.exponent_bits = exponent_bits;
    format.fraction_bits = mantissa_bits;
    format.bias = bias;
    return format;
}

constexpr int usual_bias(int exponent_bits) {
    return (1 << (exponent_bits - 1)) - 1;
}

constexpr const char* kFormatWords =
    "fp64, fp32, fp16, bf16, [u]eEmM[bB] (E 2 to 8, M 1 to 23 bits, values within fp32's range) or "
    "[u]qI.F (2 to 32 bits)";
/// kFormatWords as a regular expression, which does not know of sums and ranges of values.
constexpr const char* kFormatSpelling =
    "fp64|fp32|fp16|bf16|u?e[2-8]m([1-9]|1[0-9]|2[0-3])(b[0-9]{1,3})?|u?q[0-9]{1,2}[.][0-9]{1,2}";

/// Reads the words of a format name from left to right.
class FormatReader {
public:
    explicit FormatReader(const std::string& name) : name_(name) {}

    bool take(char c) {
        const bool there = at_ < name_.size() && name_[at_] == c;
        at_ += there ? 1 : 0;
        return there;
    }
    /// A number of up to three digits in low .. high; anything else fails.
    int number(int low, int high) {
        int value = 0;
        int digits = 0;
        for (; digits < 3 && at_ < name_.size() && std::isdigit(byte()) != 0; ++digits, ++at_) {
            value = 10 * value + (name_[at_] - '0');
        }
        if (digits == 0 || value < low || value > high) {
            fail();
        }
        return value;
    }
    bool over() const { return at_ == name_.size(); }
    [[noreturn]] void fail() const {
        throw InputError("The number format '" + name_ + "' must be " + kFormatWords + ".");
    }

private:
    unsigned char byte() const { return name_[at_]; }
    const std::string& name_;
    std::size_t at_ = 0;
};

NumberFormat read_fixed(FormatReader& reader, bool has_sign) {
    NumberFormat format;
    format.kind = NumberFormat::Kind::Fixed;
    format.has_sign = has_sign;
    format.exponent_bits = format.bias = 0;
    format.integer_bits = reader.number(has_sign ? 1 : 0, 32);
    if (!reader.take('.')) {
        reader.fail();
    }
    format.fraction_bits = reader.number(0, 32);
    const int bits = format.integer_bits + format.fraction_bits;
    if (bits < 2 || bits > 32) {
        reader.fail();
    }
    return format;
}

NumberFormat read_float(FormatReader& reader, bool has_sign) {
    const int exponent_bits = reader.number(2, 8);
    if (!reader.take('m')) {
        reader.fail();
    }
    const int mantissa_bits = reader.number(1, 23);
    const int bias = reader.take('b') ? reader.number(0, 127) : usual_bias(exponent_bits);
    const NumberFormat format = float_format(exponent_bits, mantissa_bits, bias, has_sign);
    if (!format.fits_float()) {
        reader.fail();
    }
    return format;
}

std::uint64_t pattern_of(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

/// The exponent of the smallest normal value.
int lowest_exponent(const NumberFormat& format) {
    return 1 - format.bias;
}
int highest_exponent(const NumberFormat& format) {
    return (1 << format.exponent_bits) - 2 - format.bias;
}

std::int32_t bits_of(double value) {
    const auto narrow = static_cast<float>(value);
    std::int32_t bits = 0;
    std::memcpy(&bits, &narrow, sizeof bits);
    return bits;
}

} // namespace

int NumberFormat::storage_bits() const {
    return kind == Kind::Fixed ? integer_bits + fraction_bits
                               : sign_bits() + exponent_bits + fraction_bits;
}

double NumberFormat::max() const {
    if (kind == Kind::Fixed) {
        const int whole = integer_bits - sign_bits();
        return std::ldexp(1.0, whole) - quantum();
    }
    return std::ldexp(2.0 - std::ldexp(1.0, -fraction_bits), highest_exponent(*this));
}

double NumberFormat::quantum() const {
    return std::ldexp(1.0, kind == Kind::Fixed ? -fraction_bits
                                               : lowest_exponent(*this) - fraction_bits);
}

double NumberFormat::min_normal() const {
    return std::ldexp(1.0, lowest_exponent(*this));
}

bool NumberFormat::fits_float() const {
    if (kind == Kind::Fixed) {
        return magnitude_bits() <= 23;
    }
    return fraction_bits <= 23 && lowest_exponent(*this) >= -126 && highest_exponent(*this) <= 127;
}

std::string NumberFormat::name() const {
    if (kind == Kind::Fixed) {
        return std::string(has_sign ? "q" : "uq") + std::to_string(integer_bits) + "." +
               std::to_string(fraction_bits);
    }
    for (const char* known : {"fp64", "fp32", "fp16", "bf16"}) {
        if (*this == parse_format(known)) {
            return known;
        }
    }
    std::string name = std::string(has_sign ? "e" : "ue") + std::to_string(exponent_bits) + "m" +
                       std::to_string(fraction_bits);
    return bias == usual_bias(exponent_bits) ? name : name + "b" + std::to_string(bias);
}

bool operator==(const NumberFormat& a, const NumberFormat& b) {
    return a.kind == b.kind && a.has_sign == b.has_sign && a.exponent_bits == b.exponent_bits &&
           a.bias == b.bias && a.integer_bits == b.integer_bits &&
           a.fraction_bits == b.fraction_bits;
}

NumberFormat parse_format(const std::string& name) {
    if (name == "fp64") {
        return {};
    }
    if (name == "fp32") {
        return float_format(8, 23, 127, true);
    }
    if (name == "fp16") {
        return float_format(5, 10, 15, true);
    }
    if (name == "bf16") {
        return float_format(8, 7, 127, true);
    }
    FormatReader reader(name);
    const bool has_sign = !reader.take('u');
    const bool is_float = reader.take('e');
    if (!is_float && !reader.take('q')) {
        reader.fail();
    }
    const NumberFormat format =
        is_float ? read_float(reader, has_sign) : read_fixed(reader, has_sign);
    if (!reader.over()) {
        reader.fail();
    }
    return format;
}

void describe_format(ConfigVisitor& visitor, const char* key, NumberFormat& format,
                     const std::string& meaning) {
    std::string name = format.name();
    visitor.text(key, name, ("format: " + meaning).c_str());
    visitor.spelled(key, kFormatSpelling, "number format");
    try {
        format = parse_format(name);
    } catch (const InputError&) {
        visitor.require(false, {key, std::string("must be ") + kFormatWords, "fp16"});
    }
}

RoundingConstants::RoundingConstants(const NumberFormat& format)
    : fixed(format.kind == NumberFormat::Kind::Fixed) {
    if (format.is_fp64()) {
        return;
    }
    max = format.max();
    min = format.has_sign ? -max : 0.0;
    magic = 1.5 * std::ldexp(format.quantum(), 52);
    if (fixed) {
        return;
    }
    odd = 1;
    shift = 52 - format.fraction_bits;
    half_less_one = (std::uint64_t{1} << (shift - 1)) - 1;
    keep = ~((std::uint64_t{1} << shift) - 1);
    magnitude = ~std::uint64_t{0} >> format.sign_bits();
    low = pattern_of(format.min_normal());
    range = pattern_of(max) + half_less_one - low; // what still rounds down to the largest
}

/// A float that is subnormal, too large or no number.
double Rounder::beside(double x) const {
    return x >= to_.min && x <= to_.max ? (x + to_.magic) - to_.magic : outside(x);
}

double Rounder::outside(double x) const {
    if (std::isnan(x)) {
        return to_.fixed ? to_.max : x;
    }
    const double over = to_.fixed ? to_.max : std::numeric_limits<double>::infinity();
    if (x > 0) {
        return over;
    }
    return to_.min < 0 ? -over : 0.0;
}

LaneRounding::LaneRounding(const NumberFormat& format) {
    if (!format.fits_float()) {
        throw InputError("The number format '" + format.name() +
                         "' has more bits than the lanes of the array, which carry fp32.");
    }
    const bool fixed = format.kind == NumberFormat::Kind::Fixed;
    max = bits_of(format.max());
    over = fixed ? max : over;
    nan = fixed ? max : nan;
    sign = format.has_sign ? sign : 0;
    if (fixed) {
        min_normal = INT32_MAX;
        // Magnitudes of 23 bits would leave the binade of 1.5 * 2^23.
        const bool both_signs = format.magnitude_bits() <= 22;
        magic = static_cast<float>(std::ldexp(format.quantum(), 23) * (both_signs ? 1.5 : 1.0));
        high = static_cast<float>(format.max());
        low = format.has_sign ? -high : 0.0F;
        return;
    }
    shift = 23 - format.fraction_bits;
    odd = shift > 0 ? 1 : 0;
    half_less_one = shift > 0 ? (1 << (shift - 1)) - 1 : 0;
    keep = 0x7FFFFFFF & ~((1 << shift) - 1);
    // Where subnormals are those of fp32, cutting their patterns rounds them as well.
    if (lowest_exponent(format) > -126) {
        min_normal = bits_of(format.min_normal());
        magic = static_cast<float>(std::ldexp(format.quantum(), 23));
    }
}

} // namespace degs
