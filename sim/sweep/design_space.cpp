// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/design_space.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <set>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "config/config_words.hpp"
#include "config/quantity.hpp"
#include "degs/error.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/study/addressed_overrides.hpp"
#include "sim/sweep/tree_changes.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

using config_words::quote;

/// The value of a design as it stands, written as axes write theirs.
std::string own_text(const KeyDoc& key) {
    if (key.type == "integer" || key.type == "real") {
        return decimal_text(std::strtod(key.default_value.c_str(), nullptr));
    }
    return key.type == "text" ? parse_json(key.default_value).get<std::string>()
                              : key.default_value;
}

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

/// No axis varies what --set sets.
void check_overrides(const Study& study) {
    std::vector<std::string> names;
    for (const StudyDesign& design : study.designs) {
        names.push_back(design.name);
        for (const std::string& text : overrides_of(design.name, study.overrides)) {
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

/// The next combination of a design; false after the last one.
bool advance(Genes& place, const std::vector<Gene>& genes) {
    for (std::size_t a = place.size(); a-- > 1;) {
        if (++place[a] < genes[a].positions) {
            return true;
        }
        place[a] = 0;
    }
    return false;
}

void list_combinations(std::size_t design, const std::vector<Gene>& genes,
                       std::vector<Genes>& places) {
    Genes place(genes.size(), 0);
    place.front() = design;
    do {
        places.push_back(place);
    } while (advance(place, genes));
}

void list_one_at_a_time(std::size_t design, const std::vector<Gene>& genes,
                        std::vector<Genes>& places) {
    Genes place(genes.size(), DesignSpace::kOwn);
    place.front() = design;
    places.push_back(place);
    for (std::size_t a = 1; a < place.size(); ++a) {
        for (place[a] = 0; place[a] < genes[a].positions; ++place[a]) {
            places.push_back(place);
        }
        place[a] = DesignSpace::kOwn;
    }
}

/// Whether the positions of an axis are numbers of one key that rise or fall, so that neighbours
/// are alike. Numbers in one unit, or of none, are compared as they are written.
bool is_ordered(const Axis& axis) {
    if (axis.keys.size() != 1) {
        return false;
    }
    std::vector<double> numbers;
    std::set<std::string> units;
    for (const std::vector<AxisValue>& position : axis.positions) {
        const AxisValue& value = position.front();
        const std::optional<Quantity> quantity =
            value.quantity ? value.quantity : parse_quantity(value.text);
        if (!value.draw && !quantity) {
            return false;
        }
        numbers.push_back(value.draw ? value.draw->position : quantity->number);
        units.insert(value.draw ? "" : quantity->unit + (quantity->factor ? "x" : ""));
    }
    return units.size() == 1 && (std::is_sorted(numbers.begin(), numbers.end()) ||
                                 std::is_sorted(numbers.rbegin(), numbers.rend()));
}

} // namespace

DesignSpace::LoadedDesign DesignSpace::load(const StudyDesign& design,
                                            const std::vector<std::string>& overrides) {
    LoadedDesign loaded{
        design.name, design.tree,
        overrides,   load_run_config(ConfigSource::from_tree(design.tree, overrides)),
        {},          {}};
    for (KeyDoc& key : document(loaded.config)) {
        const std::string path = key.path;
        loaded.keys.emplace(path, std::move(key));
    }
    return loaded;
}

const KeyDoc& DesignSpace::key_of(const LoadedDesign& design, const std::string& path,
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

std::uint64_t bounded_product(std::uint64_t a, std::uint64_t b) {
    std::uint64_t product = 0;
    return __builtin_mul_overflow(a, b, &product) ? std::numeric_limits<std::uint64_t>::max()
                                                  : product;
}

DesignSpace::DesignSpace(const Study& study, StudyPlan& plan) : study_(study), plan_(plan) {
    for (const StudyDesign& design : study.designs) {
        for (const LoadedDesign& other : designs_) {
            if (other.name == design.name) {
                throw InputError("Two designs of the study are called " + quote(design.name) + ".");
            }
        }
        designs_.push_back(load(design, overrides_of(design.name, study.overrides)));
    }
    check_overrides(study);
    check_memory(study);
    genes_.push_back({designs_.size(), false});
    for (const Axis& axis : study.axes) {
        add_axis(axis);
    }
}

void DesignSpace::add_axis(const Axis& axis) {
    if (axis.keys.size() > 1 && !axis.random) {
        StudyPlan::LinkedAxis linked{axis.name, std::vector<std::size_t>(axis.keys.size())};
        std::iota(linked.keys.begin(), linked.keys.end(), plan_.keys.size());
        plan_.linked.push_back(std::move(linked));
    }
    plan_.keys.insert(plan_.keys.end(), axis.keys.begin(), axis.keys.end());
    for (const std::string& key : axis.keys) {
        places_[key] = axis.place;
    }
    genes_.push_back({axis.positions.size(), is_ordered(axis)});
    for (std::size_t k = 0; k < axis.keys.size(); ++k) {
        if (const std::optional<std::string> section = including_section(axis.keys[k])) {
            for (LoadedDesign& design : designs_) {
                design.files[axis.keys[k]] = own_file(design, axis, k, *section);
            }
        }
    }
}

/// The name of that file of an axis which has the values that the design has anyway, or "own".
/// Throws InputError for a file that the design cannot take.
std::string DesignSpace::own_file(const LoadedDesign& design, const Axis& axis, std::size_t k,
                                  const std::string& section) {
    const std::string own = json_text(resolved(design.config));
    std::string name = "own";
    for (const std::vector<AxisValue>& position : axis.positions) {
        ConfigNode tree = design.tree;
        const AxisValue& value = position[k];
        put_section(tree, section, file_of(design, section, value), value.place);
        const RunConfig config =
            load_run_config(ConfigSource::from_tree(std::move(tree), design.overrides));
        name = json_text(resolved(config)) == own ? file_word(value) : name;
    }
    return name;
}

/// The values of a file. Throws InputError if it cannot be read, or there is no such section.
const ConfigNode& DesignSpace::file_of(const LoadedDesign& design, const std::string& section,
                                       const AxisValue& value) {
    if (key_of(design, section, value.place).type != "section") {
        throw InputError(value.place + ": " + quote(section) +
                         " is no section, so no file can be included in it.");
    }
    const auto known = files_.find(value.text);
    const ConfigNode& file =
        known != files_.end()
            ? known->second
            : files_.emplace(value.text, ConfigSource::from_file(value.text).tree()).first->second;
    return file;
}

std::vector<NamedConfig> DesignSpace::designs() const {
    std::vector<NamedConfig> designs;
    for (const LoadedDesign& design : designs_) {
        designs.push_back({design.name, design.config});
    }
    return designs;
}

std::uint64_t DesignSpace::size_of(const Study& study) {
    std::uint64_t sum = 1;
    std::uint64_t product = 1;
    for (const Axis& axis : study.axes) {
        sum += axis.positions.size();
        product = bounded_product(product, axis.positions.size());
    }
    return bounded_product(study.designs.size(), study.one_at_a_time ? sum : product);
}

std::vector<Genes> DesignSpace::places() const {
    std::vector<Genes> places;
    for (std::size_t design = 0; design < designs_.size(); ++design) {
        if (is_product()) {
            list_combinations(design, genes_, places);
        } else {
            list_one_at_a_time(design, genes_, places);
        }
    }
    return places;
}

/// `texts` by key; a design's own values if it is empty.
StudyVariant DesignSpace::variant(const LoadedDesign& design,
                                  const std::map<std::string, std::string>& texts) const {
    StudyVariant variant{design.name, design.name, {}};
    for (const std::string& key : plan_.keys) {
        const auto file = design.files.find(key);
        const std::string own = file != design.files.end()
                                    ? file->second
                                    : own_text(key_of(design, key, places_.at(key)));
        const auto text = texts.find(key);
        variant.values.push_back(text == texts.end() ? own : text->second);
        if (variant.values.back() != own) {
            variant.name.append(" ").append(key).append("=").append(variant.values.back());
        }
    }
    return variant;
}

/// Says which memory the variant of a study has that varies it.
void DesignSpace::note_memory(const RunConfig& config, StudyVariant& variant) const {
    if (std::none_of(plan_.keys.begin(), plan_.keys.end(),
                     [](const std::string& key) { return key.rfind("memory.", 0) == 0; })) {
        return;
    }
    const nlohmann::ordered_json memory = resolved(config)["memory"];
    variant.memory_model = memory["model"].get<std::string>();
    variant.memory_name = variant.memory_model == "lpddr5"
                              ? memory["lpddr5"]["name"].get<std::string>()
                              : variant.memory_model;
}

/// Calls `change` with every key that has another value at a place than the design's own.
template <class Change>
void DesignSpace::for_each_change(const Genes& place, const Change& change) const {
    for (std::size_t a = 0; a < study_.axes.size(); ++a) {
        const Axis& axis = study_.axes[a];
        for (std::size_t k = 0; place[a + 1] != kOwn && k < axis.keys.size(); ++k) {
            change(axis.keys[k], axis.positions[place[a + 1]][k]);
        }
    }
}

DesignSpace::Added DesignSpace::add(const Genes& place) {
    const LoadedDesign& design = designs_[place.front()];
    ConfigNode tree = design.tree;
    std::map<std::string, std::string> texts;
    for_each_change(place, [&](const std::string& path, const AxisValue& value) {
        if (const std::optional<std::string> section = including_section(path)) {
            texts[path] = file_word(value);
            put_section(tree, *section, file_of(design, *section, value), value.place);
        }
    });
    for_each_change(place, [&](const std::string& path, const AxisValue& value) {
        if (!including_section(path)) { // it decides against the files
            texts[path] = value_text(value, key_of(design, path, value.place));
            put_value(tree, path, texts[path], value.place);
        }
    });
    StudyVariant made = variant(design, texts);
    const auto [known, is_new] = variants_.emplace(made.name, std::nullopt);
    if (is_new) {
        try {
            plan_.request.configs.push_back({made.name, load_run_config(ConfigSource::from_tree(
                                                            std::move(tree), design.overrides))});
            note_memory(plan_.request.configs.back().config, made);
            known->second = plan_.variants.size();
            plan_.variants.push_back(std::move(made));
        } catch (const InputError& infeasible) {
            plan_.skipped.push_back({std::move(made), infeasible.what()});
        }
    }
    return {known->second, is_new, known->first};
}

void DesignSpace::add_baseline() {
    const std::string& name = study_.baseline.empty() ? designs_.front().name : study_.baseline;
    const auto design =
        std::find_if(designs_.begin(), designs_.end(),
                     [&name](const LoadedDesign& each) { return each.name == name; });
    if (design == designs_.end()) {
        throw InputError("The baseline " + quote(name) + " is none of the study's designs.");
    }
    const auto [known, is_new] = variants_.emplace(name, 0);
    if (is_new) {
        for (auto& [other, place] : variants_) {
            place = place && other != name ? std::optional(*place + 1) : place;
        }
        plan_.variants.insert(plan_.variants.begin(), variant(*design, {}));
        note_memory(design->config, plan_.variants.front());
        plan_.request.configs.insert(plan_.request.configs.begin(), {name, design->config});
    }
    plan_.baseline = *known->second;
}

void DesignSpace::add_design(const std::string& name) {
    for (const LoadedDesign& design : designs_) {
        if (design.name == name && variants_.emplace(name, plan_.variants.size()).second) {
            plan_.variants.push_back(variant(design, {}));
            note_memory(design.config, plan_.variants.back());
            plan_.request.configs.push_back({name, design.config});
        }
    }
}

} // namespace degs::sim
