// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/study_variants.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <numeric>
#include <set>

#include <nlohmann/json.hpp>

#include "config/config_document.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "sim/study/addressed_overrides.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

using config_words::quote;
using Keys = std::map<std::string, KeyDoc>; // of one design, by path

/// A design that loads as it stands, with its keys and their values.
struct LoadedDesign {
    std::string name;
    ConfigNode tree;
    std::vector<std::string> overrides;
    RunConfig config;
    Keys keys;
};

LoadedDesign load_design(const StudyDesign& design, const std::vector<std::string>& overrides) {
    LoadedDesign loaded{design.name,
                        design.tree,
                        overrides,
                        load_run_config(ConfigSource::from_tree(design.tree, overrides)),
                        {}};
    for (KeyDoc& key : document(loaded.config)) {
        const std::string path = key.path;
        loaded.keys.emplace(path, std::move(key));
    }
    return loaded;
}

const KeyDoc& key_of(const LoadedDesign& design, const std::string& path,
                     const std::string& place) {
    const auto found = design.keys.find(path);
    if (found != design.keys.end()) {
        return found->second;
    }
    std::vector<std::string> paths;
    for (const auto& [known, doc] : design.keys) {
        paths.push_back(known);
    }
    const std::string near = config_words::nearest(path, paths);
    throw InputError(place + ": key " + quote(path) + " is unknown to the design " +
                     quote(design.name) +
                     (near.empty() ? "" : ", did you mean " + quote(near) + "?") +
                     (near.empty() ? "; 'degs config FILE' lists its keys." : ""));
}

/// The value of a design as it stands, written as axes write theirs.
std::string own_text(const KeyDoc& key) {
    if (key.type == "integer" || key.type == "real") {
        return decimal_text(std::strtod(key.default_value.c_str(), nullptr));
    }
    return key.type == "text" ? nlohmann::json::parse(key.default_value).get<std::string>()
                              : key.default_value;
}

/// Puts a value into a tree as --set would: nothing in the files overrides it.
void put(ConfigNode& section, const std::string& path, const std::string& text,
         const std::string& place) {
    const std::size_t dot = path.find('.');
    const std::string key = path.substr(0, dot);
    const auto found = std::find_if(section.children.begin(), section.children.end(),
                                    [&key](const ConfigNode& child) { return child.key == key; });
    ConfigNode& child = found != section.children.end() ? *found : section.children.emplace_back();
    child.key = key;
    if (dot != std::string::npos) {
        child.place = child.place.empty() ? place : child.place;
        child.kind = ConfigNode::Kind::kSection;
        put(child, path.substr(dot + 1), text, place);
        return;
    }
    child.kind = ConfigNode::Kind::kScalar;
    child.children.clear();
    child.quoted = false;
    child.text = text;
    child.place = place;
    child.layer = 0;
}

/// Builds the variants of a plan.
class Variants {
public:
    Variants(const Study& study, StudyPlan& plan)
        : study_(study), plan_(plan), coincide_(study.one_at_a_time) {
        for (const Axis& axis : study.axes) {
            if (axis.keys.size() > 1 && !axis.random) {
                StudyPlan::LinkedAxis linked{axis.name, std::vector<std::size_t>(axis.keys.size())};
                std::iota(linked.keys.begin(), linked.keys.end(), plan.keys.size());
                plan.linked.push_back(std::move(linked));
            }
            plan.keys.insert(plan.keys.end(), axis.keys.begin(), axis.keys.end());
            for (const std::string& key : axis.keys) {
                places_[key] = axis.place;
            }
            coincide_ = coincide_ || axis.random;
        }
    }

    void add(const LoadedDesign& design) {
        if (study_.one_at_a_time) {
            add_one_at_a_time(design);
            return;
        }
        std::vector<std::size_t> at(study_.axes.size(), 0);
        do {
            add_position(design, at);
        } while (advance(at));
    }

    /// Adds the design as it stands in front of all, unless the axes have it.
    void add_baseline(const LoadedDesign& design) {
        const auto found =
            std::find_if(plan_.variants.begin(), plan_.variants.end(),
                         [&design](const StudyVariant& v) { return v.name == design.name; });
        plan_.baseline = found - plan_.variants.begin();
        if (found == plan_.variants.end()) {
            plan_.baseline = 0;
            plan_.variants.insert(plan_.variants.begin(), variant(design, {}));
            plan_.request.configs.insert(plan_.request.configs.begin(),
                                         {design.name, design.config});
        }
    }

private:
    static constexpr std::size_t kOwn = -1; ///< position of an axis that does not vary

    void add_one_at_a_time(const LoadedDesign& design) {
        std::vector<std::size_t> at(study_.axes.size(), kOwn);
        add_position(design, at);
        for (std::size_t a = 0; a < at.size(); ++a) {
            for (at[a] = 0; at[a] < study_.axes[a].positions.size(); ++at[a]) {
                add_position(design, at);
            }
            at[a] = kOwn;
        }
    }

    /// The next combination, the last axis fastest; false after the last one.
    bool advance(std::vector<std::size_t>& at) const {
        for (std::size_t a = at.size(); a-- > 0;) {
            if (++at[a] < study_.axes[a].positions.size()) {
                return true;
            }
            at[a] = 0;
        }
        return false;
    }

    /// `texts` by key; a design's own values if it is empty.
    StudyVariant variant(const LoadedDesign& design,
                         const std::map<std::string, std::string>& texts) const {
        StudyVariant variant{design.name, design.name, {}};
        for (const std::string& key : plan_.keys) {
            const std::string own = own_text(key_of(design, key, places_.at(key)));
            const auto text = texts.find(key);
            variant.values.push_back(text == texts.end() ? own : text->second);
            if (variant.values.back() != own) {
                variant.name.append(" ").append(key).append("=").append(variant.values.back());
            }
        }
        return variant;
    }

    void add_position(const LoadedDesign& design, const std::vector<std::size_t>& at) {
        ConfigNode tree = design.tree;
        std::map<std::string, std::string> texts;
        for (std::size_t a = 0; a < at.size(); ++a) {
            const Axis& axis = study_.axes[a];
            for (std::size_t k = 0; at[a] != kOwn && k < axis.keys.size(); ++k) {
                const AxisValue& value = axis.positions[at[a]][k];
                const std::string& path = axis.keys[k];
                texts[path] = value_text(value, key_of(design, path, value.place));
                put(tree, path, texts[path], value.place);
            }
        }
        StudyVariant made = variant(design, texts);
        if (!names_.insert(made.name).second) {
            if (coincide_) {
                return;
            }
            throw InputError("The study has the point " + quote(made.name) +
                             " twice; a value of an axis is given twice.");
        }
        try {
            plan_.request.configs.push_back({made.name, load_run_config(ConfigSource::from_tree(
                                                            std::move(tree), design.overrides))});
            plan_.variants.push_back(std::move(made));
        } catch (const InputError& infeasible) {
            plan_.skipped.push_back({std::move(made), infeasible.what()});
        }
    }

    const Study& study_;
    StudyPlan& plan_;
    std::map<std::string, std::string> places_; // of the axes, by key
    std::set<std::string> names_;
    bool coincide_ = false; ///< points that are the same count once
};

/// --memory chooses the model, so no axis can.
void check_memory(const Study& study) {
    for (const Axis& axis : study.axes) {
        if (!study.memory.empty() &&
            std::find(axis.keys.begin(), axis.keys.end(), "memory.model") != axis.keys.end()) {
            throw InputError("--memory " + study.memory +
                             ": key 'memory.model' is varied by an axis at " + axis.place +
                             ", so that it cannot be set.");
        }
    }
}

void check_overrides(const Study& study, const std::vector<LoadedDesign>& designs) {
    std::vector<std::string> names;
    for (const LoadedDesign& design : designs) {
        names.push_back(design.name);
        for (const std::string& text : design.overrides) {
            for (const Axis& axis : study.axes) {
                const auto& keys = axis.keys;
                if (std::find(keys.begin(), keys.end(), override_path(text)) != keys.end()) {
                    throw InputError("--set " + text + ": key " + quote(override_path(text)) +
                                     " is varied by an axis at " + axis.place +
                                     ", so that it cannot be set.");
                }
            }
        }
    }
    check_addressees(study.overrides, names);
}

} // namespace

void plan_variants(const Study& study, StudyPlan& plan) {
    std::vector<LoadedDesign> designs;
    for (const StudyDesign& design : study.designs) {
        for (const LoadedDesign& other : designs) {
            if (other.name == design.name) {
                throw InputError("Two designs of the study are called " + quote(design.name) + ".");
            }
        }
        designs.push_back(load_design(design, overrides_of(design.name, study.overrides)));
    }
    check_overrides(study, designs);
    check_memory(study);
    Variants variants(study, plan);
    for (const LoadedDesign& design : designs) {
        variants.add(design);
    }
    if (plan.variants.empty()) {
        throw InputError("No point of the study can be built; the first one: " +
                         plan.skipped.front().why);
    }
    const std::string& name = study.baseline.empty() ? designs.front().name : study.baseline;
    const auto baseline =
        std::find_if(designs.begin(), designs.end(),
                     [&name](const LoadedDesign& design) { return design.name == name; });
    if (baseline == designs.end()) {
        throw InputError("The baseline " + quote(name) + " is none of the study's designs.");
    }
    variants.add_baseline(*baseline);
}

} // namespace degs::sim
