// SPDX-License-Identifier: Apache-2.0
#include "tests/random/draw_value.hpp"

#include <algorithm>
#include <cstdio>

#include "degs/error.hpp"
#include "modules/kit/config/number_choice.hpp"

namespace degs::trials {
namespace {

std::string shortest(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string draw_integer(Dice& dice, const Key& key) {
    const auto low = static_cast<std::int64_t>(key.low);
    const auto high = static_cast<std::int64_t>(key.high);
    const auto value = static_cast<std::int64_t>(key.value);
    std::int64_t drawn = 0;
    switch (dice.below(5)) {
    case 0:
        drawn = low + dice.log_integer(0, 3);
        break;
    case 1:
        drawn = high - dice.log_integer(0, 3);
        break;
    case 2:
        drawn = value + dice.log_integer(0, 4) - 2;
        break;
    case 3:
        drawn = dice.log_integer(std::max(low, value / 8), std::min(high, value * 8 + 8));
        break;
    default:
        drawn = dice.log_integer(low, high);
        break;
    }
    return std::to_string(std::clamp(drawn, low, high));
}

std::string draw_real(Dice& dice, const Key& key) {
    switch (dice.below(5)) {
    case 0:
        return shortest(key.low);
    case 1:
        return shortest(key.high);
    case 2:
        return shortest(dice.uniform(key.low, key.high));
    default:
        return shortest(dice.log_uniform(std::max(key.low, key.high * 1e-6), key.high));
    }
}

/// An arithmetic, and in most draws some parts that differ, as far as its set can have them.
std::string draw_numbers(Dice& dice) {
    const int count = static_cast<int>(arithmetic_names().size());
    NumberChoice choice(static_cast<Arithmetic>(dice.below(count)));
    const int sizes[] = {0, 0, 1, 1, 2, 3, 5, 9};
    for (int i = sizes[dice.below(8)]; i > 0; --i) {
        const std::vector<Key> parts = keys_of(choice.set());
        const Key& part = draw_key(dice, parts);
        std::string text = choice.text();
        text.append(":").append(part.path).append("=").append(draw_value(dice, part));
        try {
            choice = read_numbers(text, {"drawn", ""});
        } catch (const InputError&) { // as where values need a sign
        }
    }
    return choice.text();
}

/// Texts are names, number sets and formats of their parts, or words of the documentation.
std::string draw_text(Dice& dice, const Key& key) {
    static const std::vector<std::string> names{"x", "a design", "degs-64", "gscore-64"};
    static const std::vector<std::string> formats{"fp64",  "fp32",      "fp16",   "bf16",   "e6m9",
                                                  "e8m23", "q18.12",    "q16.16", "uq0.16", "q12.8",
                                                  "e5m10", "ue6m14b50", "uq3.13", "q6.20"};
    if (key.path == "name") {
        return dice.one_of(names);
    }
    if (key.path == "pipeline.numbers") {
        return draw_numbers(dice);
    }
    if (key.doc.rfind("format", 0) == 0) {
        return dice.one_of(formats);
    }
    std::vector<std::string> words{"0", "1", "16", "256"};
    std::string word;
    for (const char c : key.doc.substr(0, key.doc.find(':')) + ' ') {
        if (c != ' ' && c != ',') {
            word += c;
        } else if (!word.empty()) {
            words.push_back(word);
            word.clear();
        }
    }
    return dice.one_of(words);
}

/// The part of a path up to and without the dot behind `begin`.
std::string head_of(const std::string& path, std::size_t begin) {
    return path.substr(0, path.find('.', begin));
}

} // namespace

std::string draw_value(Dice& dice, const Key& key) {
    switch (key.kind) {
    case Key::Kind::Integer:
        return draw_integer(dice, key);
    case Key::Kind::Real:
        return draw_real(dice, key);
    case Key::Kind::Word:
        return dice.one_of(key.words);
    default:
        return draw_text(dice, key);
    }
}

const Key& draw_key(Dice& dice, const std::vector<Key>& keys) {
    std::vector<const Key*> left;
    for (const Key& key : keys) {
        left.push_back(&key);
    }
    for (std::size_t begin = 0; left.size() > 1;) {
        std::vector<std::string> heads; // siblings, keys and sections
        for (const Key* key : left) {
            const std::string head = head_of(key->path, begin);
            if (heads.empty() || heads.back() != head) {
                heads.push_back(head);
            }
        }
        const std::string chosen = dice.one_of(heads);
        left.erase(
            std::remove_if(left.begin(), left.end(),
                           [&](const Key* key) { return head_of(key->path, begin) != chosen; }),
            left.end());
        begin = chosen.size() + 1;
    }
    return *left.front();
}

} // namespace degs::trials
