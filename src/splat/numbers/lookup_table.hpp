// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "splat/numbers/number_format.hpp"

namespace degs {

/// log2(e) / 2: exp(-q / 2) = 2^-(kHalfLog2e q).
constexpr double kHalfLog2e = 0.72134752044448170;

/// The functions of the tables. All fall with x.
enum class TableFunction {
    SqrtOneMinus, ///< sqrt(1 - x), x in 0 .. 1 (paper Sec. IV-A)
    ExpHalf,      ///< exp(-x / 2), x >= 0 (paper Eq. 21)
    Exp2,         ///< 2^-x, x >= 0
};

/// `Exact`: no table; the function is rounded once to the format of the values. `Nearest`: one
/// value per cell, the middle of the function's range there. `Linear`: value and fall per cell,
/// moved by half the largest distance between chord and curve.
enum class Interpolation { Exact, Nearest, Linear };

/// `None`: cells of equal width from 0 to `range`. `Binary`: sqrt(1 - x) takes the leading zeros of
/// 1 - x in pairs and looks up a mantissa in 1/4 .. 1; the exponentials take the integer part of
/// their binary logarithm and look up a fraction in 0 .. 1. A shift puts the result in its place.
enum class Reduction { None, Binary };

struct TableSpec {
    TableFunction function = TableFunction::SqrtOneMinus;
    Interpolation interpolation = Interpolation::Exact;
    Reduction reduction = Reduction::None;
    int entries = 0;     ///< cells, 1 .. 4096; 0 if there is no table
    double range = 1;    ///< of x with Reduction::None; beyond it the last cell counts
    NumberFormat values; ///< of entries, of the product in Linear, and of their difference
    /// Format of x log2(e) / 2, which ExpHalf forms for Reduction::Binary. In front of a table the
    /// constant is that of a fixed multiplier; without a table it is rounded to this format, too.
    NumberFormat argument;

    void describe(ConfigVisitor& visitor);
};
inline TableSpec table_of(TableFunction function) {
    TableSpec spec;
    spec.function = function;
    return spec;
}

/// One table, evaluated as a unit of the hardware evaluates it: every product and sum is rounded to
/// `values`.
class LookupTable {
public:
    LookupTable() = default;
    /// Throws InputError if entries or range are not possible.
    explicit LookupTable(const TableSpec& spec);

    double operator()(double x) const;
    const TableSpec& spec() const { return spec_; }
    /// Largest distance of a result from the function, beside rounding: of the result itself with
    /// Reduction::None, else relative to the power of two that the table's result is shifted by.
    double shape_error() const;
    /// Tables with cells that this process has filled so far: work that other formats must not
    /// cost.
    static std::uint64_t filled();

    /// For lanes: per cell, the value at its lower end and the fall to its upper end (0 if
    /// Nearest), by cells of the reduced argument.
    const std::vector<float>& lane_values() const { return lane_values_; }
    const std::vector<float>& lane_falls() const { return lane_falls_; }

private:
    double exact(double x) const;
    double curve(double reduced) const; // what the cells tabulate
    double look_up(double reduced) const;
    double reduced_root(double x) const;
    double reduced_exponential(double x) const;

    TableSpec spec_;
    Rounder round_, round_argument_;
    double low_ = 0, width_ = 1, cells_per_unit_ = 1; // of the reduced argument
    std::vector<double> values_, falls_;
    std::vector<float> lane_values_, lane_falls_;
};

} // namespace degs
