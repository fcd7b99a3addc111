// SPDX-License-Identifier: Apache-2.0
#include "sim/command_line/decimal_numbers.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "config/config_words.hpp"

namespace degs::sim {
namespace {

std::string refusal(const std::string& text, const char* allowed) {
    return config_words::quote(text) + " is not " + allowed;
}

/// Leading zeros are taken away, so that the library reads the rest in decimal.
std::string make_decimal(std::string& text, bool sign_allowed, const char* allowed) {
    const bool negative = sign_allowed && !text.empty() && text.front() == '-';
    const auto digits = text.begin() + (negative ? 1 : 0);
    if (digits == text.end() ||
        !std::all_of(digits, text.end(), [](char c) { return c >= '0' && c <= '9'; })) {
        return refusal(text, allowed);
    }
    text.erase(digits, std::find_if(digits, text.end() - 1, [](char c) { return c != '0'; }));
    return {};
}

std::string check_integer(std::string& text) {
    return make_decimal(text, true, "an integer in decimal digits");
}

std::string check_unsigned(std::string& text) {
    return make_decimal(text, false, "an integer of at least 0 in decimal digits");
}

std::string check_real(std::string& text) {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && rest == end && std::isfinite(value)
               ? std::string()
               : refusal(text, "a finite number in decimal digits");
}

/// What the library calls a type, and how it is checked.
constexpr std::pair<const char*, std::string (*)(std::string&)> kChecks[] = {
    {"INT", check_integer}, {"UINT", check_unsigned}, {"FLOAT", check_real}};

void require_decimal(CLI::Option& option) {
    // "INT", "INT:INT in [1 - 64]", or "METRES:FLOAT in [0 - 10]" where the option has a word of
    // its own.
    const std::string type = option.get_type_name();
    const std::size_t colon = std::min(type.find(':'), type.size());
    for (const auto& [name, check] : kChecks) {
        if (type.substr(0, colon) == name ||
            type.compare(colon, std::string(name).size() + 2, std::string(":") + name + " ") == 0) {
            option.transform(CLI::Validator(check, ""));
            return;
        }
    }
}

} // namespace

void require_decimal_numbers(CLI::App& app) {
    for (CLI::Option* option : app.get_options()) {
        require_decimal(*option);
    }
    for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
        require_decimal_numbers(*command);
    }
}

} // namespace degs::sim
