// SPDX-License-Identifier: Apache-2.0
#include "config/config_scalar.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "config/config_words.hpp"
#include "config/error.hpp"

namespace degs::config_scalar {
namespace {

using config_words::quote;
using Kind = ConfigNode::Kind;

std::string describe(const ConfigNode& node) {
    switch (node.kind) {
    case Kind::kSection:
        return "is a section";
    case Kind::kList:
        return "is a list";
    case Kind::kNull:
        return "has no value";
    case Kind::kScalar:
        break;
    }
    return "is " + (node.quoted ? "the quoted text " : std::string()) + quote(node.text);
}

bool is_plain(const ConfigNode& node) {
    return node.kind == Kind::kScalar && !node.quoted;
}

/// from_chars alone would take "1" of "1e3" and words such as inf and nan.
template <class Number>
std::optional<Number> parse_all(const std::string& text, const char* letters) {
    Number value{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool clean = text.find_first_not_of(letters) == std::string::npos;
    return clean && stop == end && error == std::errc() ? std::optional(value) : std::nullopt;
}

/// 010 means ten to YAML 1.2 and eight to YAML 1.1.
bool has_leading_zero(const std::string& text) {
    const std::size_t first = text.front() == '-' ? 1 : 0;
    return text.size() > first + 1 && text[first] == '0';
}

} // namespace

void reject(const ConfigNode& node, const std::string& path, const std::string& allowed) {
    throw InputError(node.place + ": key " + quote(path) + " " + describe(node) + ", but must be " +
                     allowed + ".");
}

std::int64_t integer(const ConfigNode& node, const std::string& path, std::int64_t low,
                     std::int64_t high) {
    const std::string range = config_words::range(low, high);
    const std::string allowed =
        "an integer in decimal digits, " + (range == "any" ? "64 bits" : range);
    if (!is_plain(node) || node.text.empty() || has_leading_zero(node.text)) {
        reject(node, path, allowed);
    }
    const auto value = parse_all<std::int64_t>(node.text, "-0123456789");
    if (!value || *value < low || *value > high) {
        reject(node, path, allowed);
    }
    return *value;
}

double real(const ConfigNode& node, const std::string& path, double low, double high) {
    const std::string range = config_words::range(low, high);
    const std::string allowed = "a finite number" + (range == "any" ? "" : ", " + range);
    const auto value =
        is_plain(node) ? parse_all<double>(node.text, "+-.0123456789eE") : std::optional<double>();
    if (!value || *value < low || *value > high) {
        reject(node, path, allowed);
    }
    return *value;
}

bool boolean(const ConfigNode& node, const std::string& path) {
    if (!is_plain(node) || (node.text != "true" && node.text != "false")) {
        reject(node, path, "true or false");
    }
    return node.text == "true";
}

const std::string& text(const ConfigNode& node, const std::string& path) {
    if (node.kind != Kind::kScalar) {
        reject(node, path, "a text (\"\" for an empty one)");
    }
    return node.text;
}

int choice(const ConfigNode& node, const std::string& path, const std::vector<const char*>& names) {
    const auto found = std::find(names.begin(), names.end(), node.text);
    if (node.kind == Kind::kScalar && found != names.end()) {
        return static_cast<int>(found - names.begin());
    }
    const std::vector<std::string> words(names.begin(), names.end());
    const std::string near = config_words::nearest(node.text, words);
    reject(node, path,
           "one of " + config_words::list(words) +
               (near.empty() ? "" : " (did you mean " + quote(near) + "?)"));
}

} // namespace degs::config_scalar
