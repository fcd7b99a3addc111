// SPDX-License-Identifier: Apache-2.0
#include "splat/numbers/lookup_table.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

#include "degs/error.hpp"

namespace degs {
namespace {

constexpr double kMostShift = 126; // what a float's exponent can take

/// x limited to low .. high; high if x is NaN.
double within(double x, double low, double high) {
    const double below = x < high ? x : high;
    return below > low ? below : low;
}

/// The exponent of a normal number. The library's frexp and ldexp are calls, and rows are solved by
/// the million.
int exponent_of(double x) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    return static_cast<int>(bits >> 52U & 0x7FFU) - 1023;
}

/// 2^exponent, a normal number.
double power_of_two(int exponent) {
    const std::uint64_t bits = static_cast<std::uint64_t>(exponent + 1023) << 52U;
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

/// Largest distance between the curve and its chord over [a, b]. The functions have no inflection,
/// so one golden section search finds it.
template <class Curve>
double chord_distance(const Curve& curve, double a, double b) {
    const double rise = (curve(b) - curve(a)) / (b - a);
    const auto distance = [&](double x) { return curve(a) + rise * (x - a) - curve(x); };
    constexpr double kGolden = 0.61803398874989485;
    double low = a;
    double high = b;
    for (int step = 0; step < 60; ++step) {
        const double span = kGolden * (high - low);
        const bool left = std::abs(distance(high - span)) > std::abs(distance(low + span));
        (left ? high : low) = left ? low + span : high - span;
    }
    return distance((low + high) / 2);
}

std::atomic<std::uint64_t> tables_filled{0};

} // namespace

void TableSpec::describe(ConfigVisitor& visitor) {
    visitor.choice("interpolation", interpolation, {"exact", "nearest", "linear"},
                   "no table, or what a cell holds");
    visitor.choice("reduction", reduction, {"none", "binary"},
                   "argument as it is, or reduced to a power of two");
    visitor.integer("entries", entries, 0, 4096, "cells of the table; 0: no table");
    visitor.require_at_least("entries", entries, interpolation == Interpolation::Exact ? 0 : 1,
                             "where there is a table", {"interpolation"});
    visitor.real("range", range, 1e-3, 1e3, "of the argument, if it is not reduced");
    describe_format(visitor, "values", values, "entries and results");
    if (function != TableFunction::SqrtOneMinus) {
        describe_format(visitor, "argument", argument,
                        "q log2(e) / 2, in front of the table of a natural exponent");
    }
}

std::uint64_t LookupTable::filled() {
    return tables_filled;
}

LookupTable::LookupTable(const TableSpec& spec)
    : spec_(spec), round_(spec.values), round_argument_(spec.argument) {
    if (spec.interpolation == Interpolation::Exact) {
        return;
    }
    if (spec.entries < 1 || spec.entries > 4096 || !(spec.range > 0)) {
        throw InputError("A lookup table has 1 to 4096 entries and a range above 0, not " +
                         std::to_string(spec.entries) + " entries.");
    }
    ++tables_filled;
    const bool reduced = spec.reduction == Reduction::Binary;
    const bool root = spec.function == TableFunction::SqrtOneMinus;
    low_ = reduced && root ? 0.25 : 0.0;
    width_ = (reduced ? 1.0 - low_ : spec.range) / spec.entries;
    cells_per_unit_ = 1 / width_;
    for (int i = 0; i < spec.entries; ++i) {
        const double a = low_ + width_ * i;
        const double b = low_ + width_ * (i + 1);
        const auto tabulated = [this](double x) { return curve(x); };
        if (spec.interpolation == Interpolation::Nearest) {
            values_.push_back(round_((curve(a) + curve(b)) / 2));
            falls_.push_back(0);
        } else {
            const double lift = chord_distance(tabulated, a, b) / 2;
            values_.push_back(round_(curve(a) - lift));
            falls_.push_back(round_(std::abs(curve(a) - curve(b))));
        }
        lane_values_.push_back(static_cast<float>(values_.back()));
        lane_falls_.push_back(static_cast<float>(falls_.back()));
    }
}

double LookupTable::exact(double x) const {
    switch (spec_.function) {
    case TableFunction::SqrtOneMinus:
        return std::sqrt(std::max(0.0, 1 - x));
    case TableFunction::ExpHalf:
        return std::exp(-0.5 * x);
    case TableFunction::Exp2:
        break;
    }
    return std::exp2(-x);
}

double LookupTable::curve(double reduced) const {
    if (spec_.reduction == Reduction::None) {
        return exact(reduced);
    }
    // Roots of the mantissa rise; the fractions of exponentials fall.
    return spec_.function == TableFunction::SqrtOneMinus ? std::sqrt(reduced) : std::exp2(-reduced);
}

double LookupTable::look_up(double reduced) const {
    const double at = (reduced - low_) * cells_per_unit_;
    const double last = spec_.entries - 1;
    const auto i = static_cast<std::int32_t>(within(at, 0, last));
    const double cell = i;
    const double value = values_[i];
    if (spec_.interpolation == Interpolation::Nearest) {
        return value;
    }
    const double part = round_(falls_[i] * within(at - cell, 0, 1));
    const bool rises =
        spec_.reduction == Reduction::Binary && spec_.function == TableFunction::SqrtOneMinus;
    return round_(rises ? value + part : value - part);
}

double LookupTable::reduced_root(double x) const {
    const double left = 1 - x;
    if (!(left > 0)) {
        return 0;
    }
    const int exponent = exponent_of(left) + 1; // left is 2^exponent times 1/2 .. 1
    const int pairs = exponent < 0 ? -exponent / 2 : 0;
    return look_up(left * power_of_two(2 * pairs)) * power_of_two(-pairs);
}

double LookupTable::reduced_exponential(double x) const {
    const bool natural = spec_.function == TableFunction::ExpHalf;
    const double binary =
        within(natural ? round_argument_(x * kHalfLog2e) : x, -kMostShift, kMostShift);
    const double whole = std::floor(binary);
    return look_up(binary - whole) * power_of_two(-static_cast<int>(whole));
}

double LookupTable::operator()(double x) const {
    if (spec_.interpolation == Interpolation::Exact) {
        const bool binary =
            spec_.reduction == Reduction::Binary && spec_.function == TableFunction::ExpHalf;
        return round_(binary ? std::exp2(-round_argument_(x * round_argument_(kHalfLog2e)))
                             : exact(x));
    }
    if (spec_.reduction == Reduction::None) {
        return look_up(x);
    }
    return spec_.function == TableFunction::SqrtOneMinus ? reduced_root(x) : reduced_exponential(x);
}

double LookupTable::shape_error() const {
    double worst = 0;
    for (int i = 0; i < (spec_.interpolation == Interpolation::Exact ? 0 : spec_.entries); ++i) {
        const double a = low_ + width_ * i;
        const double b = low_ + width_ * (i + 1);
        const auto tabulated = [this](double x) { return curve(x); };
        const double half = spec_.interpolation == Interpolation::Nearest
                                ? std::abs(curve(a) - curve(b)) / 2
                                : std::abs(chord_distance(tabulated, a, b)) / 2;
        worst = std::max(worst, half);
    }
    return worst;
}

} // namespace degs
