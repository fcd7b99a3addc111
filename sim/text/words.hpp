// SPDX-License-Identifier: Apache-2.0
// Numbers as people read them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/grouped_number.hpp"
#include "config/quantity.hpp"

namespace degs::sim {

using degs::decimal_text;
using degs::grouped;
/// Three significant digits without exponent: 2.108 -> "2.11", 473.9 -> "474", 51234 -> "51200".
std::string three_digits(double value);
/// Values of a column with three significant digits, or with as many as it takes that values that
/// differ do not look alike.
std::vector<std::string> told_apart(const std::vector<double>& values);
/// The shortest decimal that reads back to the value that was meant: a short one that the value
/// misses by no more than rounding does (2.178 for 2.1780000000000004, which a sum made), else the
/// value's own.
std::string decimal_of(double value);
/// Three decimals at most: 113.78133 -> "113.781", 204.8 -> "204.8".
std::string three_decimals(double value);
/// 54512345 -> "54.5 M"; k, M, G and T are decimal.
std::string scaled(double value);
inline std::string scaled(std::uint64_t value) {
    return scaled(static_cast<double>(value));
}
/// 54512345 -> "54.5 MB", 448 -> "448 B".
std::string scaled_bytes(std::uint64_t bytes);
/// 1 -> "1 view", 2000 -> "2 000 views".
std::string count_words(std::uint64_t count, const char* one, const char* many);
/// 42.4 -> "42 s", 150 -> "2 min 30 s", 7500 -> "2 h 5 min".
std::string time_words(double seconds);
/// 0.834 -> "83.4"; the percent sign is the caller's.
std::string percent(double share, int decimals = 1);
/// Characters of a UTF-8 text: bytes that do not continue one.
std::size_t characters(const std::string& text);
inline bool starts_character(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
}

} // namespace degs::sim
