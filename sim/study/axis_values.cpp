// SPDX-License-Identifier: Apache-2.0
#include "sim/study/axis_values.hpp"

#include <algorithm>
#include <cmath>

#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

using config_words::quote;
using Kind = ConfigNode::Kind;

constexpr double kRounding = 1e-9; ///< of the end of a range, relative

/// The pieces of "LOW..HIGH REST".
struct Span {
    std::string low, high, rest;
};

[[noreturn]] void fail_range(const ConfigNode& node, const std::string& reason) {
    const std::string key = node.key.empty() ? "" : "key " + quote(node.key) + ": ";
    throw InputError(node.place + ": " + key + "the range " + quote(node.text) + " " + reason +
                     ".");
}

/// Only what begins like a number is a range, because names may contain dots.
std::optional<Span> span_of(const ConfigNode& node) {
    const std::string& text = node.text;
    const std::size_t dots = text.find("..");
    const bool number = text.find_first_of("-x0123456789") == 0;
    if (node.kind != Kind::kScalar || dots == std::string::npos || !number) {
        return {};
    }
    const std::size_t space = std::min(text.find(' ', dots), text.size());
    Span span{text.substr(0, dots), text.substr(dots + 2, space - dots - 2), ""};
    span.rest = text.substr(std::min(text.find_first_not_of(' ', space), text.size()));
    return span;
}

Quantity bound(const ConfigNode& node, const std::string& text) {
    const std::optional<Quantity> quantity = parse_quantity(text);
    if (!quantity) {
        fail_range(node, "has the bound " + quote(text) +
                             ", but a number with an optional unit is needed, as in "
                             "16KB..256KB x2");
    }
    return *quantity;
}

/// Both bounds, which must have the same unit and be in order.
std::pair<Quantity, Quantity> bounds(const ConfigNode& node, const Span& span) {
    const Quantity low = bound(node, span.low);
    const Quantity high = bound(node, span.high);
    if (low.unit != high.unit || low.factor != high.factor) {
        fail_range(node, "needs the same unit at both bounds, as in 16KB..256KB x2");
    }
    if (high.number < low.number) {
        fail_range(node, "ends below its beginning");
    }
    return {low, high};
}

std::vector<AxisValue> read_range(const ConfigNode& node, const Span& span) {
    auto [value, high] = bounds(node, span);
    const bool times = !span.rest.empty() && span.rest.front() == 'x';
    const bool plus = !span.rest.empty() && span.rest.front() == '+';
    const std::optional<Quantity> step = parse_quantity(plus    ? span.rest.substr(1)
                                                        : times ? span.rest
                                                                : "");
    if (!step || step->factor != times || (!times && step->unit != value.unit)) {
        fail_range(node, "needs a step: x2 doubles from value to value, and +4 adds 4 in the unit "
                         "of the bounds");
    }
    if (times ? step->number <= 1 || value.number <= 0 : step->number <= 0) {
        fail_range(node,
                   times ? "needs a factor above 1 and bounds above 0" : "needs a step above 0");
    }
    const double low = value.number;
    std::vector<AxisValue> values;
    while (value.number <= high.number + kRounding * std::abs(high.number)) {
        if (values.size() == kMostAxisPositions) {
            fail_range(node, "has more than " + std::to_string(kMostAxisPositions) + " values");
        }
        values.push_back({node.place, "", value, {}});
        const auto count = static_cast<double>(values.size());
        value.number = times ? low * std::pow(step->number, count) : low + step->number * count;
    }
    return values;
}

} // namespace

std::optional<Draw> read_interval(const ConfigNode& node) {
    const std::optional<Span> span = span_of(node);
    if (!span || (!span->rest.empty() && span->rest != "log")) {
        return {};
    }
    const auto [low, high] = bounds(node, *span);
    if (span->rest == "log" && low.number <= 0) {
        fail_range(node, "needs bounds above 0 for log");
    }
    return Draw{low, high, span->rest == "log", 0};
}

std::vector<AxisValue> read_values(const ConfigNode& node) {
    if (const std::optional<Span> span = span_of(node)) {
        return read_range(node, *span);
    }
    if (node.kind == Kind::kScalar) {
        return {{node.place, node.text, {}, {}}};
    }
    std::vector<AxisValue> values;
    for (const ConfigNode& item : node.children) {
        if (node.kind != Kind::kList || item.kind != Kind::kScalar) {
            break;
        }
        const std::vector<AxisValue> more = read_values(item);
        values.insert(values.end(), more.begin(), more.end());
    }
    if (values.empty() || values.size() < node.children.size()) {
        throw InputError(node.place + ": key " + quote(node.key) +
                         " must be a list of values, or a range such as 16KB..256KB x2.");
    }
    if (values.size() > kMostAxisPositions) {
        throw InputError(node.place + ": key " + quote(node.key) + " has more than " +
                         std::to_string(kMostAxisPositions) + " values.");
    }
    return values;
}

} // namespace degs::sim
