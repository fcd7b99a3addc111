// SPDX-License-Identifier: Apache-2.0
#include "sim/text/words.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace degs::sim {
namespace {

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

/// Rounded to three significant digits, so that 999.6 is 1000 before its unit is chosen.
double rounded(double value) {
    if (value == 0 || !std::isfinite(value)) {
        return value;
    }
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2);
    return std::round(value / unit) * unit;
}

} // namespace

std::string three_digits(double value) {
    const double shown = rounded(value);
    if (shown == 0 || !std::isfinite(shown)) {
        return fixed(shown, 0);
    }
    const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(shown)) + 1e-9));
    return fixed(shown, std::clamp(2 - magnitude, 0, 9));
}

std::string as_typed(double value) {
    char text[64];
    std::snprintf(text, sizeof text, "%.15g", value);
    return text;
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

std::string percent(double share, int decimals) {
    return fixed(share * 100, decimals);
}

std::size_t characters(const std::string& text) {
    return std::count_if(text.begin(), text.end(), starts_character);
}

} // namespace degs::sim
