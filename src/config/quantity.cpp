// SPDX-License-Identifier: Apache-2.0
#include "config/quantity.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "config/config_words.hpp"
#include "degs/error.hpp"

namespace degs {
namespace {

using config_words::quote;

/// A unit, the word with which the sentence of a key in that dimension begins, and the unit in
/// terms of the key's.
struct Unit {
    const char* name;
    const char* meaning;
    double factor;
};

constexpr double kKibi = 1024;
constexpr std::array<Unit, 22> kUnits{{
    {"B", "bytes", 1},
    {"KB", "bytes", kKibi},
    {"MB", "bytes", kKibi* kKibi},
    {"GB", "bytes", kKibi* kKibi* kKibi},
    {"KiB", "bytes", kKibi},
    {"MiB", "bytes", kKibi* kKibi},
    {"GiB", "bytes", kKibi* kKibi* kKibi},
    {"MB/s", "1e9 bytes/s", 1e-3},
    {"GB/s", "1e9 bytes/s", 1},
    {"TB/s", "1e9 bytes/s", 1e3},
    {"%", "share", 0.01},
    {"MHz", "GHz", 1e-3},
    {"GHz", "GHz", 1},
    {"ns", "ns", 1},
    {"us", "ns", 1e3},
    {"px", "px", 1},
    {"cycles", "cycles", 1},
    {"mm2", "mm2", 1},
    {"MT/s", "MT/s", 1},
    {"pJ/bit", "pJ/bit", 1},
    {"mW", "mW", 1},
    {"nJ", "nJ", 1},
}};

/// Whether the sentence of a key begins with the whole words `meaning`.
bool means(const QuantityKey& key, const std::string& meaning) {
    const std::string& doc = key.doc;
    return doc.compare(0, meaning.size(), meaning) == 0 &&
           (doc.size() == meaning.size() ||
            std::isalnum(static_cast<unsigned char>(doc[meaning.size()])) == 0);
}

/// Whether the text behind a number is a unit, or a word that somebody takes for one. What follows
/// 1 in 1e3, 1e and 0x10 is not.
bool looks_like_unit(const std::string& text) {
    const auto is_known = [&text](const Unit& unit) { return text == unit.name; };
    const auto is_of_word = [](char c) {
        return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '/';
    };
    return std::any_of(kUnits.begin(), kUnits.end(), is_known) ||
           (!text.empty() && text != "e" && text != "E" &&
            std::all_of(text.begin(), text.end(), is_of_word));
}

/// 010 means ten to YAML 1.2 and eight to YAML 1.1.
bool has_leading_zero(const std::string& text) {
    const std::size_t first = text.find_first_not_of('-');
    return first != std::string::npos && text[first] == '0' && first + 1 < text.size() &&
           std::isdigit(static_cast<unsigned char>(text[first + 1])) != 0;
}

/// The decimal number at the front of [at, end); moves `at` behind it.
std::optional<double> take_number(const char*& at, const char* end) {
    double number = 0;
    const auto [stop, error] = std::from_chars(at, end, number, std::chars_format::fixed);
    if (error != std::errc() || !std::isfinite(number)) { // "inf" is a number to from_chars
        return {};
    }
    at = stop;
    return number;
}

} // namespace

std::optional<Quantity> parse_quantity(const std::string& text) {
    const char* at = text.data();
    const char* const end = at + text.size();
    Quantity quantity;
    quantity.factor = at != end && *at == 'x';
    at += quantity.factor ? 1 : 0;
    const std::optional<double> number = take_number(at, end);
    if (!number) {
        return {};
    }
    quantity.number = *number;
    if (quantity.factor) {
        if (at != end && *at == '/') {
            const std::optional<double> divisor = take_number(++at, end);
            if (!divisor || *divisor == 0) {
                return {};
            }
            quantity.number /= *divisor;
        }
        return at == end ? std::optional(quantity) : std::nullopt;
    }
    while (at != end && *at == ' ') {
        ++at;
    }
    quantity.unit.assign(at, end);
    return quantity;
}

std::string decimal_text(double value) {
    char text[64];
    std::snprintf(text, sizeof text, "%.15g", value);
    return text;
}

std::vector<std::string> units_of(const QuantityKey& key) {
    std::vector<std::string> names;
    for (const Unit& unit : kUnits) {
        if (means(key, unit.meaning)) {
            names.emplace_back(unit.name);
        }
    }
    return names;
}

double in_unit_of(const QuantityKey& key, const Quantity& quantity, const std::string& place) {
    if (quantity.unit.empty()) {
        return quantity.number;
    }
    for (const Unit& unit : kUnits) {
        if (quantity.unit == unit.name && means(key, unit.meaning)) {
            return quantity.number * unit.factor;
        }
    }
    const std::vector<std::string> units = units_of(key);
    throw InputError(place + ": the unit " + quote(quantity.unit) + " does not fit key " +
                     quote(key.path) + " (" + key.doc +
                     "); its units: " + (units.empty() ? "none" : config_words::list(units)) + ".");
}

ConfigNode in_unit_of(const QuantityKey& key, const ConfigNode& node) {
    if (node.kind != ConfigNode::Kind::kScalar || node.quoted) {
        return node;
    }
    const std::optional<Quantity> quantity = parse_quantity(node.text);
    if (!quantity || quantity->factor || has_leading_zero(node.text) ||
        !looks_like_unit(quantity->unit)) {
        return node;
    }
    ConfigNode converted = node;
    converted.text = decimal_text(in_unit_of(key, *quantity, node.place));
    return converted;
}

} // namespace degs
