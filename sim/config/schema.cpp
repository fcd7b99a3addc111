// SPDX-License-Identifier: Apache-2.0
#include "sim/config/schema.hpp"

#include <map>

#include "base/json_text.hpp"
#include "config/config_schema.hpp"
#include "modules/kit/config/number_choice.hpp"
#include "sim/design/run_config.hpp"
#include "sim/study/study_schema.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kLeastShared = 200; ///< bytes of a section that is worth a definition

ordered_json head(const std::string& title) {
    ordered_json document;
    document["$schema"] = "https://json-schema.org/draft/2020-12/schema";
    document["title"] = title;
    document["$defs"]["include"] = include_schema();
    return document;
}

/// Sections that several accelerators have alike, as definitions that all of them name.
class Sharing {
public:
    void count(const ordered_json& section) {
        for (const auto& [key, value] : section["properties"].items()) {
            if (value.contains("properties")) {
                ++counts_[dump_json(value)];
                count(value);
            }
        }
    }
    void replace(ordered_json& section, const std::string& path, ordered_json& definitions) {
        for (auto& [key, value] : section["properties"].items()) {
            if (!value.contains("properties")) {
                continue;
            }
            const std::string below = path + key;
            const std::string text = dump_json(value);
            if (counts_[text] < 2 || text.size() < kLeastShared) {
                replace(value, below + ".", definitions);
                continue;
            }
            std::string& name = names_[text];
            if (name.empty()) {
                name = below;
                while (definitions.contains(name)) {
                    name += "-";
                }
                definitions[name] = value;
            }
            value = schema_reference(name);
        }
    }

private:
    std::map<std::string, int> counts_;
    std::map<std::string, std::string> names_;
};

std::map<std::string, ordered_json> designs_by_accelerator() {
    std::map<std::string, ordered_json> designs;
    for (const std::string& name : accelerator_names()) {
        designs[name] = schema(default_run_config(name, {}));
    }
    // A file of cost constants has the rows of all accelerators, and a mistake in any is one.
    const ordered_json::json_pointer costs("/properties/cost/properties");
    for (auto& [name, design] : designs) {
        for (const std::string& other : accelerator_names()) {
            design[costs][other] = ordered_json(designs.at(other)[costs][other]);
        }
    }
    return designs;
}

/// The keys are those of the accelerator that the file names. A file that includes another may
/// leave the name to it, and then must suit one of them; a file without both is a design of DeGS.
ordered_json choice_of_accelerator() {
    ordered_json all = ordered_json::array();
    ordered_json by_name = ordered_json::array();
    for (const std::string& name : accelerator_names()) {
        all.push_back(schema_reference(name));
        ordered_json named;
        named["if"]["properties"]["accelerator"]["const"] = name;
        named["if"]["required"] = {"accelerator"};
        named["then"] = schema_reference(name);
        by_name.push_back(named);
    }
    ordered_json open;
    open["if"]["required"] = {"include"};
    open["then"]["anyOf"] = all;
    open["else"] = all.front();
    ordered_json unnamed;
    unnamed["if"]["required"] = {"accelerator"};
    unnamed["then"]["properties"]["accelerator"]["enum"] = accelerator_names();
    unnamed["else"] = open;
    by_name.push_back(unnamed);
    ordered_json design;
    design["type"] = "object";
    design["allOf"] = by_name;
    return design;
}

void add_designs(ordered_json& document) {
    std::map<std::string, ordered_json> designs = designs_by_accelerator();
    Sharing sharing;
    for (const auto& [name, design] : designs) {
        sharing.count(design);
    }
    for (const std::string& name : accelerator_names()) {
        ordered_json& design = designs.at(name);
        sharing.replace(design, "section.", document["$defs"]);
        document["$defs"][name] = design;
    }
}

ordered_json design_document() {
    ordered_json document = head("Design of a DeGS simulation");
    add_designs(document);
    document.update(choice_of_accelerator());
    return document;
}

ordered_json study_document() {
    ordered_json document = head("Study of DeGS designs");
    add_designs(document);
    document["$defs"]["design"] = choice_of_accelerator();
    std::vector<KeyDoc> keys;
    for (const std::string& name : accelerator_names()) {
        const std::vector<KeyDoc> own = degs::document(default_run_config(name, {}));
        keys.insert(keys.end(), own.begin(), own.end());
    }
    add_study_schema(document, keys);
    return document;
}

/// A file of `memory: { lpddr5: { include: FILE } }`, and of --memory.
ordered_json memory_document() {
    ordered_json document = head("LPDDR5 memory of a DeGS design");
    const ordered_json design = designs_by_accelerator().begin()->second;
    document.update(design["properties"]["memory"]["properties"]["lpddr5"]);
    document["type"] = "object";
    return document;
}

/// A file of `cost: { include: FILE }`, which has the rows of all accelerators.
ordered_json technology_document() {
    ordered_json document = head("Technology of the DeGS cost model");
    ordered_json all;
    for (const auto& [name, design] : designs_by_accelerator()) {
        ordered_json cost = design["properties"]["cost"];
        if (all.empty()) {
            all = cost;
        }
        for (const auto& [key, value] : cost["properties"].items()) {
            const bool rows = value.contains("properties") || !value.contains("description") ||
                              !all["properties"].contains(key);
            if (rows) {
                all["properties"][key] = value;
            }
        }
    }
    document.update(all);
    document["type"] = "object";
    return document;
}

void remove_defaults(ordered_json& properties) {
    for (auto& [key, value] : properties.items()) {
        value.erase("default");
        if (value.contains("properties")) {
            remove_defaults(value["properties"]);
        }
    }
}

/// A file that `pipeline.numbers` names. Its base, which another file may say, decides what parts
/// are that the file does not name.
ordered_json numbers_document() {
    ordered_json document = head("Number set of a DeGS design");
    document.update(schema(NumberFile{"", number_set("ideal")}));
    document["type"] = "object";
    remove_defaults(document["properties"]);
    document["anyOf"] = {{{"required", {"base"}}}, {{"required", {"include"}}}};
    return document;
}

} // namespace

std::vector<std::string> schema_names() {
    return {"design", "study", "memory", "technology", "numbers"};
}

std::string schema_text(const std::string& name) {
    const ordered_json document = name == "design"    ? design_document()
                                  : name == "study"   ? study_document()
                                  : name == "memory"  ? memory_document()
                                  : name == "numbers" ? numbers_document()
                                                      : technology_document();
    return dump_json(document, 1) + "\n";
}

} // namespace degs::sim
