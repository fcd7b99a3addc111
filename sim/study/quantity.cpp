// SPDX-License-Identifier: Apache-2.0
#include "sim/study/quantity.hpp"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "base/error.hpp"
#include "config/config_words.hpp"

namespace degs::sim {
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
bool means(const KeyDoc& key, const std::string& meaning) {
    const std::string& doc = key.doc;
    return doc.compare(0, meaning.size(), meaning) == 0 &&
           (doc.size() == meaning.size() ||
            std::isalnum(static_cast<unsigned char>(doc[meaning.size()])) == 0);
}

std::string units_of(const KeyDoc& key) {
    std::vector<std::string> names;
    for (const Unit& unit : kUnits) {
        if (means(key, unit.meaning)) {
            names.emplace_back(unit.name);
        }
    }
    return names.empty() ? "none" : config_words::list(names);
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

double in_unit_of(const KeyDoc& key, const Quantity& quantity, const std::string& place) {
    if (quantity.factor) {
        return quantity.number * std::strtod(key.default_value.c_str(), nullptr);
    }
    if (quantity.unit.empty()) {
        return quantity.number;
    }
    for (const Unit& unit : kUnits) {
        if (quantity.unit == unit.name && means(key, unit.meaning)) {
            return quantity.number * unit.factor;
        }
    }
    throw InputError(place + ": the unit " + quote(quantity.unit) + " does not fit key " +
                     quote(key.path) + " (" + key.doc + "); its units: " + units_of(key) + ".");
}

} // namespace degs::sim
