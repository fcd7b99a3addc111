// SPDX-License-Identifier: Apache-2.0
#include "config/config_reader.hpp"

#include <algorithm>
#include <cmath>

#include "config/config_scalar.hpp"
#include "config/config_words.hpp"
#include "config/quantity.hpp"

namespace degs {
namespace {

using config_scalar::value_of;
using config_words::join_path;
using config_words::quote;
using Kind = ConfigNode::Kind;

/// The value of a number, which may have a unit that fits the sentence of the key.
template <class Kind>
auto number_of(const Kind& kind, const ConfigNode& node, const std::string& path, const char* doc) {
    const ConfigNode converted = in_unit_of({path, doc}, node);
    const auto value = kind.read(converted);
    if (!value) {
        ConfigNode shown = node;
        shown.text += converted.text == node.text ? "" : " = " + converted.text;
        config_scalar::reject(shown, path, kind.allowed(node));
    }
    return *value;
}

constexpr const char* kDefault = "default"; // the place of what no source names

/// " at file:line", " at line N" where the file is that of `before`, " by --set" of an option.
std::string short_place(const std::string& place, const std::string& before) {
    if (place.rfind("--", 0) == 0) {
        return " by " + place.substr(0, place.find(' '));
    }
    const std::size_t colon = place.rfind(':') + 1;
    const bool same = place.compare(0, colon, before, 0, colon) == 0;
    return " at " + (same ? "line " + place.substr(colon) : place);
}

void require_section(const ConfigNode& node, const std::string& path) {
    if (node.kind != Kind::kSection && node.kind != Kind::kNull) {
        config_scalar::reject(node, path, "a section of keys");
    }
}

} // namespace

ConfigReader::ConfigReader(const ConfigSource& source) : source_(source) {
    open_.push_back({"", &source.root_});
    known_[""];
}

std::string ConfigReader::declare(const char* key) {
    const std::string& section = open_.back().path;
    std::vector<std::string>& keys = known_[section];
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) {
        throw std::logic_error("describe() names the key " + quote(join_path(section, key)) +
                               " twice");
    }
    keys.emplace_back(key);
    return join_path(section, key);
}

std::string ConfigReader::path_of(const char* key) const {
    return join_path(open_.back().path, key);
}

template <class Parse>
bool ConfigReader::each_value(const char* key, const Parse& parse) {
    const std::string path = declare(key);
    const ConfigNode* section = open_.back().node;
    const ConfigNode* in_file = section == nullptr ? nullptr : section->find(key);
    const auto* set = source_.override_of(path);
    if (in_file != nullptr) {
        parse(*in_file, path);
    }
    if (set != nullptr) {
        parse(set->value, path);
    }
    return in_file != nullptr || set != nullptr;
}

/// A struct that a program filled is held to the same ranges as a file. Written so that NaN fails.
template <class Number>
void ConfigReader::check_standing(const std::string& path, Number value, Number low,
                                  Number high) const {
    if (!(value >= low && value <= high)) {
        throw InputError(std::string(kDefault) + ": key " + quote(path) + " is " +
                         config_words::number(value) + ", but must be " +
                         config_words::range(low, high) + ".");
    }
}

void ConfigReader::begin_section(const char* key, const char*) {
    const std::string path = declare(key);
    const ConfigNode* outer = open_.back().node;
    const ConfigNode* node = outer == nullptr ? nullptr : outer->find(key);
    if (node != nullptr) {
        require_section(*node, path);
    }
    known_[path];
    open_.push_back({path, node});
}

void ConfigReader::end_section() {
    open_.pop_back();
}

void ConfigReader::integer(const char* key, std::int64_t& value, std::int64_t low,
                           std::int64_t high, const char* doc) {
    const std::int64_t before = value;
    const bool given = each_value(key, [&](const ConfigNode& node, const std::string& path) {
        value = number_of(config_scalar::Integer{low, high}, node, path, doc);
    });
    if (!given) {
        check_standing(path_of(key), value, low, high);
    }
    note(key, before != value, config_words::number(value));
}

void ConfigReader::real(const char* key, double& value, double low, double high, const char* doc) {
    const double before = value;
    const bool given = each_value(key, [&](const ConfigNode& node, const std::string& path) {
        value = number_of(config_scalar::Real{low, high}, node, path, doc);
    });
    if (!given) {
        check_standing(path_of(key), value, low, high);
    }
    note(key, before != value, config_words::number(value));
}

void ConfigReader::boolean(const char* key, bool& value, const char*) {
    const bool before = value;
    each_value(key, [&](const ConfigNode& node, const std::string& path) {
        value = value_of(config_scalar::Boolean{}, node, path);
    });
    note(key, before != value, value ? "true" : "false");
}

void ConfigReader::text(const char* key, std::string& value, const char*) {
    const std::string before = value;
    each_value(key, [&](const ConfigNode& node, const std::string& path) {
        value = value_of(config_scalar::Text{}, node, path);
    });
    note(key, before != value, quote(value));
}

ConfigOrigin ConfigReader::origin(const char* key) const {
    const std::string path = path_of(key);
    return {source_.place(path) + ": key " + quote(path), source_.folder(path)};
}

void ConfigReader::replaced(const char* key, const char* advice) {
    replaced_[path_of(key)] = advice;
}

void ConfigReader::choice(const char* key, int& value, const std::vector<const char*>& names,
                          const char* doc) {
    const int before = value;
    const bool given = each_value(key, [&](const ConfigNode& node, const std::string& path) {
        value = value_of(config_scalar::Choice{names, doc}, node, path);
    });
    if (!given) {
        const std::int64_t last = names.size() - 1;
        check_standing(path_of(key), std::int64_t{value}, std::int64_t{0}, last);
    }
    note(key, before != value, names[value]);
}

void ConfigReader::note(const char* key, bool changed, const std::string& value) {
    const std::string path = path_of(key);
    values_[path] = value;
    if (changed) {
        changed_.insert(path);
    }
}

// True if a key, or a key below a section, was given a value in another way than by its default.
bool ConfigReader::is_changed(const std::string& path) const {
    const auto next = changed_.lower_bound(path);
    return next != changed_.end() && (*next == path || next->rfind(path + ".", 0) == 0);
}

void ConfigReader::require(bool holds, const ConfigRule& rule) {
    if (!holds && broken_rule_.empty()) {
        broken_rule_ = sentence_of(rule);
    }
}

void ConfigReader::advise(bool in_proportion, const ConfigRule& rule) {
    if (!in_proportion) {
        warnings_.push_back(sentence_of(rule));
    }
}

void ConfigReader::advise_if_set(bool of_use, const ConfigRule& rule) {
    const ConfigSource::Given given = source_.strongest(path_of(rule.key));
    if (given.node != nullptr && given.node->layer == 0) {
        advise(of_use, rule);
    }
}

/// "<place>: key '<key>' is <value>, but <rule>; <remedy> would do (<other> is <value> at
/// <place>)." The place is that of the key, or of the first of the others that a source names.
std::string ConfigReader::sentence_of(const ConfigRule& rule) const {
    const std::string path = path_of(rule.key);
    const std::string own = source_.place(path);
    std::string lead = own;
    std::string others;
    std::string latest = own;
    for (const char* key : rule.others) {
        const std::string place = source_.place(path_of(key));
        lead = lead == kDefault ? place : lead;
        if (place != kDefault) {
            others += (others.empty() ? "" : ", ") + path_of(key) + " is " +
                      values_.at(path_of(key)) + (place == lead ? "" : short_place(place, latest));
            latest = place.rfind("--", 0) == 0 ? latest : place;
        }
    }
    return lead + ": key " + quote(path) + " is " + values_.at(path) +
           (own == lead ? "" : " by default") + ", but " + rule.rule +
           (rule.remedy.empty() ? "" : "; " + rule.remedy + " would do") +
           (others.empty() ? "" : " (" + others + ")") + ".";
}

void ConfigReader::unused(const char* key, const char* decider, const char* reason) {
    const std::string& section = open_.back().path;
    const ConfigSource::Given given = source_.strongest(join_path(section, key));
    const ConfigSource::Given by = source_.strongest(join_path(section, decider));
    if (given.node != nullptr && is_changed(join_path(section, key)) &&
        (by.node == nullptr || given.node->layer <= by.node->layer)) {
        warnings_.push_back(given.node->place + ": key " + quote(given.path) +
                            " has no effect, because " + reason + ".");
    }
}

void ConfigReader::of_others(const char* section, const std::vector<const char*>& keys,
                             const char* reason) {
    std::vector<std::string>& known = known_[path_of(section)];
    for (const char* key : keys) {
        if (std::find(known.begin(), known.end(), key) != known.end()) {
            continue;
        }
        const std::string path = join_path(path_of(section), key);
        of_others_.push_back(path + ".");
        for (const auto& override : source_.overrides_) {
            if (override.path.rfind(of_others_.back(), 0) == 0) {
                warnings_.push_back(override.value.place + ": key " + quote(override.path) +
                                    " has no effect, because " + reason + ".");
            }
        }
    }
}

void ConfigReader::finish() const {
    reject_unknown(source_.root_, "");
    for (const auto& override : source_.overrides_) {
        reject_unknown(override.path, override.value.place);
    }
    if (!broken_rule_.empty()) {
        throw InputError(broken_rule_);
    }
}

void ConfigReader::reject_unknown(const ConfigNode& section, const std::string& path) const {
    const auto known = known_.find(path);
    if (known == known_.end()) {
        return; // a value; its parser has looked at it
    }
    for (const ConfigNode& child : section.children) {
        const auto& keys = known->second;
        const std::string below = join_path(path, child.key);
        if (is_of_others(below + ".")) {
            require_section(child, below);
            continue;
        }
        if (std::find(keys.begin(), keys.end(), child.key) == keys.end()) {
            fail_unknown(child.place, path, child.key);
        }
        reject_unknown(child, below);
    }
}

// Whether a section, or a key below one, belongs to other structs.
bool ConfigReader::is_of_others(const std::string& path) const {
    return std::any_of(of_others_.begin(), of_others_.end(),
                       [&](const std::string& section) { return path.rfind(section, 0) == 0; });
}

void ConfigReader::reject_unknown(const std::string& override_path,
                                  const std::string& place) const {
    if (is_of_others(override_path)) {
        return;
    }
    std::string section;
    std::string rest = override_path;
    while (known_.count(section) != 0) {
        const std::string key = rest.substr(0, rest.find('.'));
        const auto& keys = known_.at(section);
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
            fail_unknown(place, section, rest);
        }
        section = join_path(section, key);
        if (key.size() == rest.size()) {
            break;
        }
        rest.erase(0, key.size() + 1);
    }
    if (known_.count(section) != 0) {
        throw InputError(
            place + ": key " + quote(section) +
            " is a section; set one of its keys: " + config_words::list(known_.at(section)) + ".");
    }
    if (section != override_path) {
        throw InputError(place + ": key " + quote(override_path) + " is unknown, because " +
                         quote(section) + " is a single value.");
    }
}

void ConfigReader::fail_unknown(const std::string& place, const std::string& section,
                                const std::string& key) const {
    const std::string written = join_path(section, key);
    if (const std::string* known_advice = advice_of(written)) {
        throw InputError(place + ": key " + quote(written) + " is unknown; " + *known_advice + ".");
    }
    const std::string meant = guess(section, key);
    const std::string keys = config_words::list(known_.at(section));
    std::string advice = meant.empty() ? "" : ", did you mean " + quote(meant) + "?";
    if (meant == written) { // a key with a dot in its name
        const std::size_t dot = meant.rfind('.');
        advice = ", because " + quote(meant.substr(dot + 1)) + " has to stand in the section " +
                 quote(meant.substr(0, dot)) + ".";
    }
    throw InputError(place + ": key " + quote(written) + " is unknown" + advice + " (allowed " +
                     (section.empty() ? "at the top" : "in " + quote(section)) + ": " +
                     (keys.empty() ? "nothing" : keys) + ").");
}

/// What is said about a replaced key, or about one in a replaced section.
const std::string* ConfigReader::advice_of(const std::string& path) const {
    const auto found = std::find_if(replaced_.begin(), replaced_.end(), [&](const auto& each) {
        return path == each.first || path.rfind(each.first + ".", 0) == 0;
    });
    return found == replaced_.end() ? nullptr : &found->second;
}

/// A misspelt sibling first, then the same word in another section, then a misspelt section.
std::string ConfigReader::guess(const std::string& section, const std::string& key) const {
    const std::string near = config_words::nearest(key, known_.at(section));
    if (!near.empty()) {
        return join_path(section, near);
    }
    const std::string leaf = key.substr(key.rfind('.') + 1);
    for (const auto& [other, keys] : known_) {
        if (std::find(keys.begin(), keys.end(), leaf) != keys.end()) {
            return join_path(other, leaf);
        }
    }
    const std::string first = key.substr(0, key.find('.'));
    const std::string near_section = config_words::nearest(first, known_.at(section));
    return near_section.empty() ? "" : join_path(section, near_section);
}

} // namespace degs
