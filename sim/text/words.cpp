// SPDX-License-Identifier: Apache-2.0
#include "sim/text/words.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <utility>

#include "config/config_words.hpp"

namespace degs::sim {
namespace {

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

/// Rounded to significant digits, so that of three 999.6 is 1000 before its unit is chosen.
double rounded(double value, int digits = 3) {
    if (value == 0 || !std::isfinite(value)) {
        return value;
    }
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1 - digits);
    return std::round(value / unit) * unit;
}

std::string significant(double value, int digits) {
    const double shown = rounded(value, digits);
    if (shown == 0 || !std::isfinite(shown)) {
        return fixed(shown, 0);
    }
    const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(shown)) + 1e-9));
    return fixed(shown, std::clamp(digits - 1 - magnitude, 0, 9));
}

std::vector<std::string> significant(const std::vector<double>& values, int digits) {
    std::vector<std::string> texts;
    texts.reserve(values.size());
    for (const double value : values) {
        texts.push_back(significant(value, digits));
    }
    return texts;
}

template <typename T>
std::size_t different(const std::vector<T>& values) {
    return std::set<T>(values.begin(), values.end()).size();
}

} // namespace

std::string three_digits(double value) {
    return significant(value, 3);
}

std::vector<std::string> told_apart(const std::vector<double>& values) {
    constexpr int kMost = 9; // farther down, sums in another order differ
    int digits = 3;
    const std::size_t all = different(significant(values, kMost));
    while (digits < kMost && different(significant(values, digits)) < all) {
        ++digits;
    }
    return significant(values, digits);
}

std::string decimal_of(double value) {
    // One value in thirty lies so near a number of twelve digits by chance, and then moves by 1e-14
    // of itself.
    constexpr double kRoundingOfSums = 1e-14, kRoundingOfOne = 2.3e-16; // relative
    for (const auto& [digits, rounding] : {std::pair(12, kRoundingOfSums), {15, kRoundingOfOne}}) {
        char text[64];
        std::snprintf(text, sizeof text, "%.*g", digits, value);
        if (std::abs(std::strtod(text, nullptr) - value) <= rounding * std::abs(value)) {
            return text;
        }
    }
    return config_words::number(value);
}

std::string scaled(double value) {
    const char* const units[] = {"", " k", " M", " G", " T"};
    std::size_t unit = 0;
    double shown = rounded(value);
    while (shown >= 1000 && unit + 1 < sizeof units / sizeof *units) {
        shown /= 1000;
        ++unit;
    }
    return three_digits(shown) + units[unit];
}

std::string three_decimals(double value) {
    constexpr double kPerUnit = 1000;
    return decimal_text(std::round(value * kPerUnit) / kPerUnit);
}

std::string scaled_bytes(std::uint64_t bytes) {
    return scaled(bytes) + (bytes < 1000 ? " B" : "B");
}

std::string time_words(double seconds) {
    const auto whole = static_cast<std::int64_t>(std::llround(seconds));
    if (whole < 60) {
        return std::to_string(whole) + " s";
    }
    if (whole < 3600) {
        return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
    }
    return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

std::string count_words(std::uint64_t count, const char* one, const char* many) {
    return grouped(count) + " " + (count == 1 ? one : many);
}

std::string percent(double share, int decimals) {
    return fixed(share * 100, decimals);
}

std::size_t characters(const std::string& text) {
    return std::count_if(text.begin(), text.end(), starts_character);
}

} // namespace degs::sim
