// SPDX-License-Identifier: Apache-2.0
#include "splat/numbers/lookup_table.hpp"

#include <cmath>
#include <limits>
#include <tuple>

#include <gtest/gtest.h>

#include "degs/error.hpp"

namespace degs {
namespace {

double truth(TableFunction function, double x) {
    switch (function) {
    case TableFunction::SqrtOneMinus:
        return std::sqrt(1 - x);
    case TableFunction::ExpHalf:
        return std::exp(-x / 2);
    case TableFunction::Exp2:
        break;
    }
    return std::exp2(-x);
}

TableSpec spec_of(TableFunction function, Interpolation interpolation, Reduction reduction,
                  int entries, const char* values = "fp64") {
    TableSpec spec;
    spec.function = function;
    spec.interpolation = interpolation;
    spec.reduction = reduction;
    spec.entries = entries;
    spec.range = function == TableFunction::SqrtOneMinus ? 1 : 12;
    spec.values = parse_format(values);
    return spec;
}

using TableShape = std::tuple<TableFunction, Interpolation, Reduction, int>;
class Tables : public testing::TestWithParam<TableShape> {};

// Every result is within shape_error of the truth, and some result is nearly that far.
TEST_P(Tables, AreAsFarFromTheirFunctionAsTheySay) {
    const auto [function, interpolation, reduction, entries] = GetParam();
    const LookupTable table(spec_of(function, interpolation, reduction, entries));
    const bool root = function == TableFunction::SqrtOneMinus;
    double worst = 0;
    for (int i = 0; i <= 200000; ++i) {
        const double x = (root ? 1.0 : 12.0) * i / 200000;
        double scale = 1;
        if (reduction == Reduction::Binary && root) {
            scale = x < 1 ? std::pow(2.0, -std::floor(std::log(1 - x) / -std::log(4.0) - 1e-9)) : 1;
        } else if (reduction == Reduction::Binary) {
            const double orders = function == TableFunction::Exp2 ? x : x / 2 / std::log(2.0);
            scale = std::pow(2.0, -std::floor(orders + 1e-12));
        }
        worst = std::max(worst, std::abs(table(x) - truth(function, x)) / scale);
    }
    EXPECT_LE(worst, table.shape_error() * (1 + 1e-6));
    EXPECT_GE(worst, table.shape_error() * 0.97);
}
std::string shape_name(const ::testing::TestParamInfo<TableShape>& shape) {
    constexpr const char* kFunctions[] = {"SqrtOneMinus", "ExpHalf", "Exp2"};
    const auto [function, interpolation, reduction, entries] = shape.param;
    return std::string(kFunctions[static_cast<std::size_t>(function)]) +
           (interpolation == Interpolation::Linear ? "Linear" : "Nearest") +
           (reduction == Reduction::Binary ? "Binary" : "None") + std::to_string(entries);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, Tables,
    testing::Combine(testing::Values(TableFunction::SqrtOneMinus, TableFunction::ExpHalf,
                                     TableFunction::Exp2),
                     testing::Values(Interpolation::Nearest, Interpolation::Linear),
                     testing::Values(Reduction::None, Reduction::Binary), testing::Values(16, 100)),
    shape_name);

// The distance of a chord from a curve is h^2 f'' / 8; moved to the middle, half of that.
TEST(TableError, OfTheNamedTablesFollowsTheSecondDerivative) {
    const LookupTable exp2(
        spec_of(TableFunction::Exp2, Interpolation::Linear, Reduction::Binary, 16));
    const double h = 1.0 / 16;
    EXPECT_NEAR(exp2.shape_error(), h * h / 16 * std::pow(std::log(2.0), 2), 0.05e-4);
    const LookupTable root(
        spec_of(TableFunction::SqrtOneMinus, Interpolation::Linear, Reduction::Binary, 32));
    const double w = 0.75 / 32;
    EXPECT_NEAR(root.shape_error(), w * w / 16 * 2, 0.15 * w * w / 8); // f'' = -2 at 1/4
    // Nearest values of sqrt(1 - x) are worst in the last cell, from 1/16 to 0.
    const LookupTable nearest(
        spec_of(TableFunction::SqrtOneMinus, Interpolation::Nearest, Reduction::None, 256));
    EXPECT_DOUBLE_EQ(nearest.shape_error(), 1.0 / 32);
}

TEST(Table, RoundsEntriesAndResults) {
    const Rounder round(parse_format("uq1.6"));
    const LookupTable table(
        spec_of(TableFunction::Exp2, Interpolation::Linear, Reduction::None, 12, "uq1.6"));
    for (int i = 0; i <= 1200; ++i) {
        const double value = table(i / 100.0);
        EXPECT_EQ(round(value), value);
        EXPECT_NEAR(value, std::exp2(-i / 100.0), 0.02 + 1.5 / 64);
    }
    const LookupTable exact(
        spec_of(TableFunction::Exp2, Interpolation::Exact, Reduction::None, 0, "fp16"));
    EXPECT_EQ(exact(1.7), Rounder(parse_format("fp16"))(std::exp2(-1.7)));
    EXPECT_EQ(exact.shape_error(), 0);
}

TEST(Table, IsDefinedEverywhere) {
    for (const auto function :
         {TableFunction::SqrtOneMinus, TableFunction::ExpHalf, TableFunction::Exp2}) {
        for (const auto reduction : {Reduction::None, Reduction::Binary}) {
            const LookupTable table(spec_of(function, Interpolation::Linear, reduction, 8));
            for (const double x :
                 {-1e-3, 1e3, 1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
                EXPECT_GE(table(x), -0.02) << x;
                EXPECT_LE(table(x), 1.1) << x;
            }
        }
    }
}

TEST(Table, RefusesImpossibleSizes) {
    for (const int entries : {0, -1, 5000}) {
        EXPECT_THROW(LookupTable(spec_of(TableFunction::Exp2, Interpolation::Linear,
                                         Reduction::Binary, entries)),
                     InputError);
    }
    TableSpec spec = spec_of(TableFunction::Exp2, Interpolation::Nearest, Reduction::None, 4);
    spec.range = 0;
    EXPECT_THROW(LookupTable{spec}, InputError);
}

} // namespace
} // namespace degs
