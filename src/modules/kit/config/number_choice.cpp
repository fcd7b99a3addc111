// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/config/number_choice.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "config/config_scalar.hpp"
#include "config/config_source.hpp"
#include "config/config_words.hpp"
#include "config/key_walk.hpp"
#include "config/written_values.hpp"

namespace degs {
namespace {

namespace fs = std::filesystem;
using config_words::quote;
using Words = std::vector<std::string>;

constexpr const char* kNumbers = "numbers";
constexpr const char* kBase = "base";
constexpr std::size_t kMostFiles = 100; ///< each of which is the base of the one before

Words known_names() {
    return {arithmetic_names().begin(), arithmetic_names().end()};
}

std::string allowed_names() {
    return config_words::list(known_names()) +
           ", or a number file, whose path has a dot or a slash";
}

/// All texts that may be right, as a regular expression.
std::string spelling() {
    std::string names;
    for (const std::string& name : known_names()) {
        names += name + "|";
    }
    return "(" + names + "[^:]*[./][^:]*)(:[^:=]+=[^:]*)*";
}

Words split(const std::string& text) {
    Words words(1);
    for (const char c : text) {
        if (c == ':') {
            words.emplace_back();
        } else {
            words.back() += c;
        }
    }
    return words;
}

/// Collects those of the parts of a number set that have been named, with their values.
class NamedParts : public WrittenValues {
public:
    explicit NamedParts(std::set<std::string> names) : names_(std::move(names)) {}

    Words parts;

private:
    void see(const std::string& path, const std::string& value) override {
        if (names_.count(path) != 0) {
            parts.push_back(path);
            parts.back().append("=").append(value);
        }
    }
    std::set<std::string> names_;
};

Words named_parts(NumberSet set, const std::set<std::string>& names) {
    NamedParts found(names);
    KeyWalk walk(found);
    set.describe(walk);
    return found.parts;
}

void add_names(const Words& parts, std::set<std::string>& names) {
    for (const std::string& part : parts) {
        names.insert(part.substr(0, part.find('=')));
    }
}

void add_names(const ConfigNode& section, const std::string& path, std::set<std::string>& names) {
    for (const ConfigNode& child : section.children) {
        const std::string below = config_words::join_path(path, child.key);
        if (child.kind == ConfigNode::Kind::kScalar) {
            names.insert(below);
        }
        add_names(child, below, names);
    }
}

class NumberReader {
public:
    NumberChoice read(const std::string& text, const ConfigOrigin& origin) {
        Words parts = split(text);
        const std::string name = parts.front();
        parts.erase(parts.begin());
        return with_parts(named(name, origin), parts, origin);
    }

private:
    NumberChoice named(const std::string& name, const ConfigOrigin& origin);
    NumberChoice file(const fs::path& path, const ConfigOrigin& origin);
    static NumberChoice with_parts(NumberChoice choice, const Words& parts,
                                   const ConfigOrigin& origin);

    std::vector<fs::path> open_;
};

NumberChoice NumberReader::named(const std::string& name, const ConfigOrigin& origin) {
    const Words names = known_names();
    const auto known = std::find(names.begin(), names.end(), name);
    if (known != names.end()) {
        return static_cast<Arithmetic>(known - names.begin());
    }
    if (name.find_first_of("./") != std::string::npos) {
        return file((fs::path(origin.folder) / name).lexically_normal(), origin);
    }
    const std::string near = config_words::nearest(name, names);
    throw InputError(origin.place + " is " + quote(name) + ", but must be " + allowed_names() +
                     (near.empty() ? "" : " (did you mean " + quote(near) + "?)") + ".");
}

NumberChoice NumberReader::with_parts(NumberChoice choice, const Words& parts,
                                      const ConfigOrigin& origin) {
    const std::string place = origin.place + ":";
    for (const std::string& part : with_record_formats(parts, place)) {
        choice.parts.push_back(part);
    }
    std::set<std::string> names;
    add_names(choice.parts, names);
    choice.parts = named_parts(number_set(set_of(choice.base).name, choice.parts, place), names);
    return choice;
}

NumberChoice NumberReader::file(const fs::path& path, const ConfigOrigin& origin) {
    std::error_code ignored; // a path that cannot be resolved cannot be opened either
    const fs::path identity = fs::weakly_canonical(path, ignored);
    if (std::find(open_.begin(), open_.end(), identity) != open_.end()) {
        throw InputError(origin.place + " goes in a circle at " + quote(path.string()) +
                         "; a number file must not be its own base.");
    }
    if (open_.size() == kMostFiles) {
        throw InputError(origin.place + " is the base of more than " + std::to_string(kMostFiles) +
                         " number files in a row; fewer are allowed.");
    }
    open_.push_back(identity);
    const ConfigSource source =
        ConfigSource::from_tree(read_config_file(path, origin.place + ": "));
    const ConfigNode* const base = source.tree().find(kBase);
    if (base == nullptr) {
        throw InputError(path.string() + ": key 'base' is missing; a number file names the set " +
                         "from which it differs: " + allowed_names() + ".");
    }
    NumberFile content;
    content.base = config_scalar::value_of(config_scalar::Text{}, *base, kBase);
    NumberChoice choice =
        read(content.base, {base->place + ": key " + quote(kBase), folder_of(*base).string()});
    content.set = choice.set();
    source.load(content);
    std::set<std::string> names;
    add_names(choice.parts, names);
    add_names(source.tree(), "", names);
    choice.parts = named_parts(content.set, names);
    open_.pop_back();
    return choice;
}

} // namespace

std::string NumberChoice::text() const {
    std::string text = name_of(base);
    for (const std::string& part : parts) {
        text.append(":").append(part);
    }
    return text;
}

NumberSet NumberChoice::set() const {
    return number_set(set_of(base).name, parts);
}

void NumberChoice::describe(ConfigVisitor& visitor) {
    const std::string standing = text();
    std::string asked = standing;
    visitor.text(kNumbers, asked,
                 "arithmetic of spans, alpha and blending: the machine's fp32 or fp64 (also "
                 "ideal), or a number set; parts that differ stand behind it, as in "
                 "tuned:alpha=uq1.15:exp.entries=32");
    visitor.spelled(kNumbers, spelling(), allowed_names());
    if (asked != standing) {
        *this = read_numbers(asked, visitor.origin(kNumbers));
    }
}

NumberChoice read_numbers(const std::string& text, const ConfigOrigin& origin) {
    return NumberReader().read(text, origin);
}

void NumberFile::describe(ConfigVisitor& visitor) {
    visitor.text(kBase, base, "the number set from which this one differs, as in pipeline.numbers");
    visitor.spelled(kBase, spelling(), allowed_names());
    set.describe(visitor);
}

} // namespace degs
