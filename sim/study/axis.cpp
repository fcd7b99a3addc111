// SPDX-License-Identifier: Apache-2.0
#include "sim/study/axis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <set>

#include <regex.h>

#include "config/config_scalar.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "scene/synthetic/synthetic_random.hpp"
#include "sim/study/axis_values.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

using config_words::quote;
using Kind = ConfigNode::Kind;
using Values = std::vector<AxisValue>;

constexpr int kDrawsPerSample = 1000; ///< until one is found that is new
constexpr int kDigitsOfDraws = 4;     ///< drawn reals are rounded, for people who read them

[[noreturn]] void fail_axis(const ConfigNode& node, const std::string& reason) {
    throw InputError(node.place + ": axis " + quote(node.key) + " " + reason + ".");
}

void check_keys(const ConfigNode& node, const std::vector<std::string>& allowed) {
    for (const ConfigNode& child : node.children) {
        if (std::find(allowed.begin(), allowed.end(), child.key) == allowed.end()) {
            throw InputError(child.place + ": key " + quote(child.key) + " is unknown in axis " +
                             quote(node.key) + " (allowed: " + config_words::list(allowed) + ").");
        }
    }
}

/// `keys: [a, b]` with `values`: all have the same value, or the same factor.
void read_common(const ConfigNode& node, const ConfigNode& keys, Axis& axis) {
    const ConfigNode* values = node.find("values");
    if (values == nullptr) {
        fail_axis(node, "lists keys, and needs 'values' for all of them");
    }
    for (const ConfigNode& key : keys.children) {
        if (key.kind != Kind::kScalar) {
            fail_axis(node, "has something in 'keys' that is no key");
        }
        axis.keys.push_back(key.text);
    }
    for (const AxisValue& value : read_values(*values)) {
        axis.positions.emplace_back(axis.keys.size(), value);
    }
}

/// `keys: { a: VALUES, b: VALUES }`: the first of each, the second of each, and so on.
void read_linked(const ConfigNode& keys, Axis& axis) {
    std::vector<Values> columns;
    for (const ConfigNode& key : keys.children) {
        axis.keys.push_back(key.key);
        columns.push_back(read_values(key));
        if (columns.back().size() != columns.front().size()) {
            throw InputError(key.place + ": key " + quote(key.key) + " has " +
                             std::to_string(columns.back().size()) + " values, but key " +
                             quote(axis.keys.front()) + " of the same axis has " +
                             std::to_string(columns.front().size()) +
                             "; linked keys need as many as each other.");
        }
    }
    for (std::size_t p = 0; !columns.empty() && p < columns.front().size(); ++p) {
        Values position;
        for (const Values& column : columns) {
            position.push_back(column[p]);
        }
        axis.positions.push_back(std::move(position));
    }
}

/// One key of a sample: an interval, or some values.
struct Source {
    std::optional<Draw> interval;
    Values values;
    std::string place;
};

/// Draws one position; `chosen` identifies it.
Values draw(const std::vector<Source>& sources, SyntheticRandom& random,
            std::vector<double>& chosen) {
    Values position;
    for (const Source& source : sources) {
        const double u = random.uniform();
        if (source.interval) {
            AxisValue value{source.place, "", {}, source.interval};
            value.draw->position = u;
            chosen.push_back(u);
            position.push_back(value);
        } else {
            const double which = std::floor(u * static_cast<double>(source.values.size()));
            chosen.push_back(which);
            position.push_back(source.values[static_cast<std::size_t>(which)]);
        }
    }
    return position;
}

template <class Value>
Value number_of(const ConfigNode& node, const char* key, Value low, Value high, Value otherwise) {
    const ConfigNode* child = node.find(key);
    return child == nullptr
               ? otherwise
               : config_scalar::value_of(config_scalar::Integer{low, high}, *child, key);
}

/// `random: N` with `keys: { a: LOW..HIGH, b: VALUES }` and `seed`.
void read_samples(const ConfigNode& node, const ConfigNode& keys, Axis& axis) {
    axis.random = true;
    const auto most = static_cast<std::int64_t>(kMostAxisPositions);
    const std::int64_t count = number_of<std::int64_t>(node, "random", 1, most, 1);
    SyntheticRandom random(number_of<std::int64_t>(node, "seed", 0, INT64_MAX, 1));
    std::vector<Source> sources;
    for (const ConfigNode& key : keys.children) {
        axis.keys.push_back(key.key);
        Source source{read_interval(key), {}, key.place};
        source.values = source.interval ? Values() : read_values(key);
        sources.push_back(std::move(source));
    }
    std::set<std::vector<double>> known;
    for (std::int64_t s = 0; s < count; ++s) {
        Values position;
        std::vector<double> chosen;
        int draws = 0;
        do {
            if (draws++ == kDrawsPerSample) {
                fail_axis(node, "asks for " + std::to_string(count) +
                                    " samples, but its values have fewer combinations");
            }
            chosen.clear();
            position = draw(sources, random, chosen);
        } while (!known.insert(chosen).second);
        axis.positions.push_back(std::move(position));
    }
}

void check_axis(const ConfigNode& node, const Axis& axis) {
    if (axis.keys.empty()) {
        fail_axis(node, "has no keys");
    }
    for (const std::string& key : axis.keys) {
        if (std::count(axis.keys.begin(), axis.keys.end(), key) > 1) {
            fail_axis(node, "names key " + quote(key) + " twice");
        }
    }
}

/// The number in the unit of the key, which has the design's own value.
double number_for(const KeyDoc& key, const Quantity& quantity, const std::string& place) {
    return quantity.factor ? quantity.number * std::strtod(key.default_value.c_str(), nullptr)
                           : in_unit_of({key.path, key.doc}, quantity, place);
}

/// A drawn number; of an integer key, one of the integers from low to high, all as likely.
double drawn(const Draw& draw, const KeyDoc& key, const std::string& place) {
    const double low = number_for(key, draw.low, place);
    const double high = number_for(key, draw.high, place);
    const bool whole = key.type == "integer";
    const double end = whole ? std::floor(high) + 1 : high;
    const double begin = whole ? std::ceil(low) : low;
    const double value = draw.logarithmic
                             ? begin * portable_exp(portable_log(end / begin) * draw.position)
                             : begin + (end - begin) * draw.position;
    if (whole) {
        return std::clamp(std::floor(value), begin, end - 1);
    }
    char text[64];
    std::snprintf(text, sizeof text, "%.*g", kDigitsOfDraws, value);
    return std::clamp(std::strtod(text, nullptr), low, high);
}

/// Whether a text is spelled as its key says. The expression is one of POSIX, as in
/// accuracy_scene.cpp.
bool is_spelled(const std::string& text, const std::string& spelling) {
    regex_t form;
    if (spelling.empty() || ::regcomp(&form, spelling.c_str(), REG_EXTENDED | REG_NOSUB) != 0) {
        return true; // the key itself still checks it
    }
    const bool matches = ::regexec(&form, text.c_str(), 0, nullptr, 0) == 0;
    ::regfree(&form);
    return matches;
}

std::string choice_text(const AxisValue& value, const KeyDoc& key) {
    const std::string allowed = ", " + key.allowed + ",";
    if (value.text.empty() || allowed.find(", " + value.text + ",") == std::string::npos) {
        throw InputError(value.place + ": key " + quote(key.path) + " is " + quote(value.text) +
                         ", but must be one of " + key.allowed + ".");
    }
    return value.text;
}

Axis read_any_axis(const ConfigNode& node) {
    Axis axis;
    axis.name = node.key;
    axis.place = node.place;
    if (node.kind != Kind::kSection) {
        axis.keys = {node.key};
        for (const AxisValue& value : read_values(node)) {
            axis.positions.push_back({value});
        }
        return axis;
    }
    const ConfigNode* keys = node.find("keys");
    const bool random = node.find("random") != nullptr;
    const bool list = keys != nullptr && keys->kind == Kind::kList;
    if (keys == nullptr || (keys->kind != Kind::kSection && !list) || (random && list)) {
        fail_axis(node, "needs 'keys': a section of keys with their values, or a list of keys that "
                        "share 'values'");
    }
    check_keys(node, random ? std::vector<std::string>{"keys", "random", "seed"}
                     : list ? std::vector<std::string>{"keys", "values"}
                            : std::vector<std::string>{"keys"});
    if (random) {
        read_samples(node, *keys, axis);
    } else if (list) {
        read_common(node, *keys, axis);
    } else {
        read_linked(*keys, axis);
    }
    check_axis(node, axis);
    return axis;
}

/// Files are relative to the study.
void place_files(Axis& axis, const std::filesystem::path& folder) {
    for (std::vector<AxisValue>& position : axis.positions) {
        for (std::size_t k = 0; k < axis.keys.size(); ++k) {
            AxisValue& value = position[k];
            if (!including_section(axis.keys[k])) {
                continue;
            }
            if (value.text.empty()) {
                throw InputError(value.place + ": key " + quote(axis.keys[k]) +
                                 " needs names of files.");
            }
            value.text = (folder / value.text).lexically_normal().string();
        }
    }
}

} // namespace

std::optional<std::string> including_section(const std::string& key) {
    constexpr const char* kInclude = ".include";
    const std::size_t dot = key.rfind('.');
    return dot != std::string::npos && dot != 0 && key.substr(dot) == kInclude
               ? std::optional(key.substr(0, dot))
               : std::nullopt;
}

std::string file_word(const AxisValue& value) {
    return std::filesystem::path(value.text).stem().string();
}

Axis read_axis(const ConfigNode& node, const std::filesystem::path& folder) {
    Axis axis = read_any_axis(node);
    place_files(axis, folder);
    return axis;
}
std::string value_text(const AxisValue& value, const KeyDoc& key) {
    const bool number = key.type == "integer" || key.type == "real";
    if (key.type == "section") {
        throw InputError(value.place + ": " + quote(key.path) +
                         " is a section, and an axis needs one of its keys.");
    }
    if (!number && (value.quantity || value.draw)) {
        throw InputError(value.place + ": key " + quote(key.path) +
                         " is no number, so it needs a list of values.");
    }
    if (key.type == "boolean" || key.type == "choice") {
        return choice_text(value, key);
    }
    if (!number) {
        if (!is_spelled(value.text, key.spelling)) {
            throw InputError(value.place + ": key " + quote(key.path) + " is " + quote(value.text) +
                             ", but must be " + key.allowed + ".");
        }
        return value.text;
    }
    if (value.draw) {
        return decimal_text(drawn(*value.draw, key, value.place));
    }
    const std::optional<Quantity> quantity =
        value.quantity ? value.quantity : parse_quantity(value.text);
    if (!quantity) {
        throw InputError(value.place + ": key " + quote(key.path) + " is " + quote(value.text) +
                         ", but must be a number with an optional unit.");
    }
    return decimal_text(number_for(key, *quantity, value.place));
}

} // namespace degs::sim
