// SPDX-License-Identifier: Apache-2.0
#include "config/config_words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <sstream>

#include "base/visible_text.hpp"

namespace degs::config_words {
namespace {

template <class Number>
std::string range_text(bool open_below, bool open_above, const Number& low, const Number& high) {
    if (open_below && open_above) {
        return "any";
    }
    if (open_above) {
        return "at least " + low;
    }
    return open_below ? "at most " + high : low + " to " + high;
}

/// Letters to insert, delete or replace to turn one word into the other (Levenshtein, two rows).
std::size_t edit_distance(const std::string& from, const std::string& to) {
    std::vector<std::size_t> row(to.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < from.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < to.size(); ++j) {
            const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

} // namespace

std::string number(double value) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    return {buffer.data(), end};
}

std::string number(std::int64_t value) {
    return std::to_string(value);
}

std::string join_path(const std::string& section, const std::string& key) {
    return section.empty() || key.empty() ? section + key : section + "." + key;
}

std::string list(const std::vector<std::string>& words) {
    std::string joined;
    for (const std::string& word : words) {
        joined += (joined.empty() ? "" : ", ") + word;
    }
    return joined;
}

std::string quote(const std::string& text) {
    constexpr std::size_t kLongest = 60;
    return "'" + visible(text.substr(0, kLongest)) + (text.size() > kLongest ? "..." : "") + "'";
}

std::string markdown_cell(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
        text.insert(at, 1, '\\');
    }
    return text;
}

std::string range(std::int64_t low, std::int64_t high) {
    using Limits = std::numeric_limits<std::int64_t>;
    using Narrow = std::numeric_limits<int>;
    return range_text(low == Limits::min() || low == Narrow::min(),
                      high == Limits::max() || high == Narrow::max(), std::to_string(low),
                      std::to_string(high));
}

std::string range(double low, double high) {
    using Limits = std::numeric_limits<double>;
    return range_text(low <= Limits::lowest(), high >= Limits::max(), number(low), number(high));
}

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
    constexpr std::size_t kLongestWord = 100; // keeps a hostile key from costing time
    std::string best;
    std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& candidate : candidates) {
        if (word.size() > kLongestWord) {
            break;
        }
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < best_distance && distance < candidate.size()) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

std::string described(const std::string& word, const std::vector<std::string>& candidates,
                      const std::string& doc) {
    constexpr std::size_t kShortestWord = 4; // shorter ones are in every description
    std::string found;
    std::istringstream parts(doc);
    for (std::string part; word.size() >= kShortestWord && std::getline(parts, part, ';');) {
        std::istringstream description(part);
        std::string name;
        description >> name;
        const bool has = std::find(std::istream_iterator<std::string>(description), {}, word) !=
                         std::istream_iterator<std::string>();
        const auto candidate = std::find_if(candidates.begin(), candidates.end(),
                                            [&](const auto& one) { return one + ":" == name; });
        if (has && candidate != candidates.end()) {
            if (!found.empty()) {
                return "";
            }
            found = *candidate;
        }
    }
    return found;
}

} // namespace degs::config_words
