// SPDX-License-Identifier: Apache-2.0
// Arithmetic over measures, such as "energy.nj_per_frame*latency_ms".
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/report/measures.hpp"

namespace degs::sim {

/// A step of an expression in postfix order, which needs no parentheses.
struct ExpressionStep {
    enum class Kind { Number, Measure, Baseline, Add, Subtract, Multiply, Divide, Negate };
    Kind kind = Kind::Number;
    double number = 0;
    Measure measure = Measure::Count;
    std::string design{}; ///< of Baseline; empty: that of the study
};

/// Numbers, measures, + - * / and parentheses; `baseline` and `baseline(NAME)` in bounds.
class Expression {
public:
    using Kind = ExpressionStep::Kind;
    /// The number of a step without operands; empty if it does not exist.
    using Leaf = std::function<std::optional<double>(const ExpressionStep&)>;

    /// Throws InputError, which begins with `place` and suggests measures for an unknown name.
    static Expression parse(const std::string& text, const std::string& place);

    /// Empty if a leaf is, and for what is no number, such as 0 / 0.
    std::optional<double> value(const Leaf& leaf) const;
    std::optional<double> value(const Measures& measures) const;

    /// Whether small or large values are better, as far as the measures' own directions say so for
    /// measures that are not negative: a product of two that should be small should be small.
    Direction direction() const;

    const std::vector<ExpressionStep>& steps() const { return steps_; }
    bool has(Kind kind) const;

private:
    std::vector<ExpressionStep> steps_;
};

} // namespace degs::sim
