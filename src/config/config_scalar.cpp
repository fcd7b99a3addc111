// SPDX-License-Identifier: Apache-2.0
#include "config/config_scalar.hpp"

#include <cctype>
#include <charconv>

#include "config/config_words.hpp"
#include "degs/error.hpp"

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

/// 010 means ten to YAML 1.2 and eight to YAML 1.1.
bool has_leading_zero(const std::string& text) {
    const std::size_t first = text.find_first_not_of('-');
    return first != std::string::npos && text[first] == '0' && first + 1 < text.size() &&
           std::isdigit(static_cast<unsigned char>(text[first + 1])) != 0;
}

/// All of a plain scalar as a number. from_chars alone would take "1" of "1e3" and words such as
/// inf and nan.
template <class Number>
std::optional<Number> number_of(const ConfigNode& node, const char* letters) {
    const std::string& text = node.text;
    Number value{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool clean = is_plain(node) && !has_leading_zero(text) &&
                       text.find_first_not_of(letters) == std::string::npos;
    return clean && stop == end && error == std::errc() ? std::optional(value) : std::nullopt;
}

} // namespace

void reject(const ConfigNode& node, const std::string& path, const std::string& allowed) {
    throw InputError(node.place + ": key " + quote(path) + " " + describe(node) + ", but must be " +
                     allowed + ".");
}

std::optional<std::int64_t> Integer::read(const ConfigNode& node) const {
    const auto value = number_of<std::int64_t>(node, "-0123456789");
    return value && *value >= low && *value <= high ? value : std::nullopt;
}

std::string Integer::values() const {
    return config_words::range(low, high);
}

std::string Integer::allowed(const ConfigNode&) const {
    return "an integer in decimal digits, " + (values() == "any" ? "64 bits" : values());
}

std::optional<double> Real::read(const ConfigNode& node) const {
    const auto value = number_of<double>(node, "+-.0123456789eE");
    return value && *value >= low && *value <= high ? value : std::nullopt;
}

std::string Real::values() const {
    return config_words::range(low, high);
}

std::string Real::allowed(const ConfigNode&) const {
    return "a finite decimal number" + (values() == "any" ? "" : ", " + values());
}

std::optional<bool> Boolean::read(const ConfigNode& node) const {
    if (!is_plain(node) || (node.text != "true" && node.text != "false")) {
        return std::nullopt;
    }
    return node.text == "true";
}

std::optional<std::string> Text::read(const ConfigNode& node) const {
    return node.kind == Kind::kScalar ? std::optional(node.text) : std::nullopt;
}

std::optional<int> Choice::read(const ConfigNode& node) const {
    // Programs that read YAML 1.1 take on and off for truths, and write them so.
    const bool plain = node.kind == Kind::kScalar && !node.quoted;
    const std::string word = plain && node.text == "true"    ? "on"
                             : plain && node.text == "false" ? "off"
                                                             : node.text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (node.kind == Kind::kScalar && word == names[i]) {
            return static_cast<int>(i);
        }
    }
    return std::nullopt;
}

std::string Choice::values() const {
    return config_words::list({names.begin(), names.end()});
}

std::string Choice::allowed(const ConfigNode& node) const {
    const std::vector<std::string> words(names.begin(), names.end());
    std::string near = config_words::nearest(node.text, words);
    if (near.empty()) {
        near = config_words::described(node.text, words, doc);
    }
    return "one of " + values() + (near.empty() ? "" : " (did you mean " + quote(near) + "?)");
}

} // namespace degs::config_scalar
