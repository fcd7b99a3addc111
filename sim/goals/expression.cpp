// SPDX-License-Identifier: Apache-2.0
#include "sim/goals/expression.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "config/config_words.hpp"
#include "degs/error.hpp"

namespace degs::sim {
namespace {

using StepKind = ExpressionStep::Kind;
using Steps = std::vector<ExpressionStep>;

constexpr int kMostNested = 100; ///< parentheses and signs, so that a text cannot exhaust the stack

/// Reads an expression by recursive descent: a sum of products of signed leaves.
class Parser {
public:
    Parser(const std::string& text, const std::string& place) : text_(text), place_(place) {}

    Steps all() {
        sum();
        if (peek() != '\0') {
            fail("ends before " + config_words::quote(text_.substr(at_)));
        }
        return std::move(steps_);
    }

private:
    char peek() {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
            ++at_;
        }
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    bool take(char wanted) {
        const bool found = peek() == wanted;
        at_ += found ? 1 : 0;
        return found;
    }
    [[noreturn]] void fail(const std::string& why) const {
        throw InputError(place_ + " says " + config_words::quote(text_) + ", which " + why +
                         "; an expression has measures, numbers, + - * / and parentheses.");
    }
    void put(StepKind kind) { steps_.push_back({kind}); }

    void sum() {
        product();
        for (char sign = peek(); sign == '+' || sign == '-'; sign = peek()) {
            ++at_;
            product();
            put(sign == '+' ? StepKind::Add : StepKind::Subtract);
        }
    }
    void product() {
        leaf();
        for (char sign = peek(); sign == '*' || sign == '/'; sign = peek()) {
            ++at_;
            leaf();
            put(sign == '*' ? StepKind::Multiply : StepKind::Divide);
        }
    }
    void leaf() {
        if (++nested_ > kMostNested) {
            fail("is nested too deeply");
        }
        const char first = peek();
        if (take('-')) {
            leaf();
            put(StepKind::Negate);
        } else if (take('(')) {
            sum();
            if (!take(')')) {
                fail("lacks a ')'");
            }
        } else if (std::isdigit(static_cast<unsigned char>(first)) != 0 || first == '.') {
            number();
        } else {
            name();
        }
        --nested_;
    }
    void number() {
        ExpressionStep step;
        const char* const end = text_.data() + text_.size();
        const auto [stop, error] = std::from_chars(text_.data() + at_, end, step.number);
        if (error != std::errc()) {
            fail("has no number at " + config_words::quote(text_.substr(at_)));
        }
        at_ = static_cast<std::size_t>(stop - text_.data());
        steps_.push_back(step);
    }
    void name() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 ||
                                      text_[at_] == '_' || text_[at_] == '.')) {
            ++at_;
        }
        const std::string word = text_.substr(begin, at_ - begin);
        if (word.empty()) {
            fail(begin == text_.size()
                     ? "lacks something at its end"
                     : "has no measure at " + config_words::quote(text_.substr(begin)));
        }
        ExpressionStep step;
        if (word == "baseline") {
            step.kind = StepKind::Baseline;
            step.design = take('(') ? name_of_design() : "";
        } else {
            if (peek() == '(') {
                fail("has " + config_words::quote(word) +
                     " before a parenthesis; worst(...) and "
                     "mean(...) can only surround all of a goal, or the left side of a limit");
            }
            step.kind = StepKind::Measure;
            step.measure = measure_named(word, place_, {"baseline"});
        }
        steps_.push_back(step);
    }
    std::string name_of_design() {
        const std::size_t end = text_.find(')', at_);
        if (end == std::string::npos) {
            fail("lacks a ')'");
        }
        std::string design = text_.substr(at_, end - at_);
        at_ = end + 1;
        return design;
    }

    const std::string& text_;
    const std::string& place_;
    std::size_t at_ = 0;
    int nested_ = 0;
    Steps steps_;
};

double result_of(StepKind kind, double a, double b) {
    switch (kind) {
    case StepKind::Add:
        return a + b;
    case StepKind::Subtract:
        return a - b;
    case StepKind::Multiply:
        return a * b;
    case StepKind::Divide:
        return a / b;
    default:
        throw std::logic_error("no operator of two operands");
    }
}

/// What is known of a part of an expression.
struct Trend {
    Direction better = Direction::None;
    bool constant = false;
    double value = 0; ///< of a constant
};

Direction turned(Direction direction) {
    return direction == Direction::Minimise   ? Direction::Maximise
           : direction == Direction::Maximise ? Direction::Minimise
                                              : Direction::None;
}

Trend trend_of(StepKind kind, const Trend& a, Trend b) {
    if (a.constant && b.constant) {
        return {Direction::None, true, result_of(kind, a.value, b.value)};
    }
    const bool scales = kind == StepKind::Multiply || kind == StepKind::Divide;
    if (kind == StepKind::Subtract || kind == StepKind::Divide) {
        b.better = turned(b.better);
    }
    if (a.constant || b.constant) {
        const Direction better = a.constant ? b.better : a.better;
        const bool negative = scales && (a.constant ? a.value : b.value) < 0;
        return {negative ? turned(better) : better};
    }
    return {a.better == b.better ? a.better : Direction::None};
}

} // namespace

Expression Expression::parse(const std::string& text, const std::string& place) {
    Expression expression;
    expression.steps_ = Parser(text, place).all();
    return expression;
}

std::optional<double> Expression::value(const Leaf& leaf) const {
    std::vector<double> stack;
    for (const ExpressionStep& step : steps_) {
        if (step.kind == Kind::Number) {
            stack.push_back(step.number);
        } else if (step.kind == Kind::Measure || step.kind == Kind::Baseline) {
            const std::optional<double> number = leaf(step);
            if (!number) {
                return {};
            }
            stack.push_back(*number);
        } else if (step.kind == Kind::Negate) {
            stack.back() = -stack.back();
        } else {
            const double b = stack.back();
            stack.pop_back();
            stack.back() = result_of(step.kind, stack.back(), b);
        }
    }
    return std::isnan(stack.back()) ? std::nullopt : std::optional<double>(stack.back());
}

std::optional<double> Expression::value(const Measures& measures) const {
    return value([&measures](const ExpressionStep& step) {
        return step.kind == Kind::Measure ? measures[step.measure] : std::nullopt;
    });
}

Direction Expression::direction() const {
    std::vector<Trend> stack;
    for (const ExpressionStep& step : steps_) {
        if (step.kind == Kind::Number) {
            stack.push_back({Direction::None, true, step.number});
        } else if (step.kind == Kind::Measure) {
            stack.push_back({direction_of(step.measure)});
        } else if (step.kind == Kind::Baseline) {
            stack.push_back({});
        } else if (step.kind == Kind::Negate) {
            stack.back().better = turned(stack.back().better);
            stack.back().value = -stack.back().value;
        } else {
            const Trend b = stack.back();
            stack.pop_back();
            stack.back() = trend_of(step.kind, stack.back(), b);
        }
    }
    return stack.back().better;
}

bool Expression::has(Kind kind) const {
    return std::any_of(steps_.begin(), steps_.end(),
                       [kind](const ExpressionStep& step) { return step.kind == kind; });
}

} // namespace degs::sim
