// SPDX-License-Identifier: Apache-2.0
#include "sim/study/study_schema.hpp"

#include <algorithm>

#include "base/json_text.hpp"
#include "config/config_schema.hpp"
#include "config/quantity.hpp"
#include "sim/study/axis.hpp"
#include "sim/study/study_keys.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

const ordered_json kScalar{{"type", {"string", "number", "boolean"}}};

ordered_json one_or_list(const ordered_json& item) {
    return {{"anyOf",
             ordered_json::array({item, {{"type", "array"}, {"items", item}, {"minItems", 1}}})}};
}

ordered_json any_of(const ordered_json& first, const ordered_json& second) {
    return {{"anyOf", ordered_json::array({first, second})}};
}

/// What an axis may say of a number: values, factors, ranges of both, and with `drawn` the
/// intervals of samples.
ordered_json numbers(const std::vector<std::string>& units, bool drawn) {
    const std::string number = number_pattern();
    const std::string factor = "x" + number + "(/" + number + ")?";
    const std::string plain =
        units.empty() ? number : "(" + number + "|" + quantity_pattern(units) + ")";
    const std::string bound = "(" + plain + "|" + factor + ")";
    const std::string step = "( +" + factor + "| +\\+" + plain + (drawn ? "| +log|" : "") + ")";
    const std::string pattern = "^" + bound + "(\\.\\." + bound + step + ")?$";
    return {{"type", {"number", "string"}}, {"pattern", pattern}};
}

/// The names of a choice, as KeyDoc lists them.
std::vector<std::string> names_in(const std::string& list) {
    const std::string comma = ", ";
    std::vector<std::string> names;
    std::size_t begin = 0;
    while (begin <= list.size()) {
        const std::size_t end = std::min(list.find(comma, begin), list.size());
        names.push_back(list.substr(begin, end - begin));
        begin = end + comma.size();
    }
    return names;
}

/// The values of one key in an axis. Definitions of numbers are shared by keys of the same units.
ordered_json axis_values(const KeyDoc& key, bool drawn, ordered_json& definitions) {
    if (key.type == "boolean") {
        return one_or_list({{"type", "boolean"}});
    }
    if (key.type == "choice") {
        return one_or_list({{"enum", names_in(key.allowed)}});
    }
    if (key.type == "text") {
        return one_or_list(key.spelling.empty()
                               ? kScalar
                               : ordered_json{{"type", "string"}, {"pattern", key.spelling}});
    }
    const std::vector<std::string> units = units_of({key.path, key.doc});
    std::string name = drawn ? "samples" : "values";
    for (const char c : units.empty() ? "" : "-in-" + units.front()) {
        name += c == '/' || c == '%' ? '-' : c; // what a reference could not name
    }
    if (!definitions.contains(name)) {
        definitions[name] = one_or_list(numbers(units, drawn));
    }
    return schema_reference(name);
}

/// Every key with its values.
ordered_json keys_with_values(const std::vector<KeyDoc>& keys, bool drawn,
                              ordered_json& definitions) {
    ordered_json properties = ordered_json::object();
    for (const KeyDoc& key : keys) {
        if (key.type == "section") {
            properties[key.path + ".include"] = {
                {"description", "a file with values of " + key.path}};
            properties[key.path + ".include"].update(one_or_list({{"type", "string"}}));
            continue;
        }
        const ordered_json values = axis_values(key, drawn, definitions);
        if (!properties.contains(key.path)) {
            properties[key.path] = {{"description", key.doc}};
            properties[key.path].update(values);
        } else {
            ordered_json& known = properties[key.path];
            ordered_json before = known;
            before.erase("description");
            if (before != values) {
                known = {{"description", key.doc}, {"anyOf", {before, values}}};
            }
        }
    }
    return properties;
}

ordered_json section(const ordered_json& properties, const std::vector<std::string>& needed) {
    ordered_json json{{"type", "object"}};
    json["properties"] = properties;
    json["additionalProperties"] = false;
    if (!needed.empty()) {
        json["required"] = needed;
    }
    return json;
}

/// The three kinds of axes with several keys.
ordered_json joint_axis(const std::vector<KeyDoc>& keys, ordered_json& definitions) {
    ordered_json names = ordered_json::array();
    definitions["varied-keys"] = section(keys_with_values(keys, true, definitions), {});
    for (const auto& [name, values] : definitions["varied-keys"]["properties"].items()) {
        names.push_back(name);
    }
    const ordered_json count{{"type", "integer"}, {"minimum", 1}, {"maximum", kMostAxisPositions}};
    const ordered_json seed{{"type", "integer"}, {"minimum", 0}, {"default", 1}};
    const ordered_json list{{"type", "array"}, {"items", {{"enum", names}}}, {"minItems", 1}};
    ordered_json values = one_or_list(kScalar);
    ordered_json properties;
    properties["keys"] = any_of(schema_reference("varied-keys"), list);
    properties["keys"]["description"] = "keys with their values, or a list of keys that share "
                                        "'values'";
    properties["values"] = values;
    properties["random"] = count;
    properties["random"]["description"] = "how many samples are drawn";
    properties["seed"] = seed;
    return section(properties, {"keys"});
}

ordered_json axes_schema(const std::vector<KeyDoc>& keys, ordered_json& definitions) {
    definitions["axis"] = joint_axis(keys, definitions);
    ordered_json properties = keys_with_values(keys, false, definitions);
    for (auto& [name, values] : properties.items()) {
        const std::string doc = values["description"];
        values.erase("description");
        ordered_json both{{"description", doc}, {"if", {{"type", "object"}}}};
        both["then"] = schema_reference("axis");
        both["else"] = values;
        values = both;
    }
    return {{"type", {"object", "null"}},
            {"properties", properties},
            {"additionalProperties", schema_reference("axis")}};
}

ordered_json number_of(const StudyKey& key) {
    if (key.kind == StudyKind::kInteger) {
        return {{"type", "integer"},
                {"minimum", static_cast<std::int64_t>(key.low)},
                {"maximum", static_cast<std::int64_t>(key.high)}};
    }
    return {{"type", "number"}, {"minimum", key.low}, {"maximum", key.high}};
}

ordered_json views_schema();

ordered_json words_schema(const StudyKey& key) {
    ordered_json word = kScalar;
    if (!key.pattern.empty()) {
        word = {{"type", {"string", "integer"}}, {"pattern", key.pattern}};
    }
    return one_or_list(word);
}

ordered_json schema_of(const StudyKey& key, const std::vector<KeyDoc>& keys,
                       ordered_json& definitions) {
    switch (key.kind) {
    case StudyKind::kText:
        return kScalar;
    case StudyKind::kWords:
        return words_schema(key);
    case StudyKind::kInteger:
    case StudyKind::kReal:
        return number_of(key);
    case StudyKind::kBoolean:
        return {{"type", "boolean"}};
    case StudyKind::kChoice:
        return {{"enum", key.words}};
    case StudyKind::kViews:
        return views_schema();
    case StudyKind::kDesigns:
        return {{"type", "array"}, {"items", schema_reference("named-design")}, {"minItems", 1}};
    case StudyKind::kAxes:
        return axes_schema(keys, definitions);
    }
    return {};
}

ordered_json described(const StudyKey& key, const ordered_json& values) {
    ordered_json json{{"description", key.doc}};
    json.update(values);
    if (*key.default_value != '\0') {
        const bool plain = key.kind == StudyKind::kText || key.kind == StudyKind::kChoice;
        json["default"] =
            plain ? ordered_json(key.default_value) : parse_ordered_json(key.default_value);
    }
    return json;
}

/// Keys of which one takes the place of the other, in 'quick', too.
void add_exclusion(ordered_json& section) {
    section["not"]["anyOf"] = ordered_json::array();
    for (const auto& [one, other] :
         {std::pair("width", "resolutions"), std::pair("views", "cameras"),
          std::pair("views", "eyes"), std::pair("views", "path_step")}) {
        section["not"]["anyOf"].push_back({{"required", {one, other}}});
    }
}

ordered_json views_schema() {
    ordered_json properties;
    ordered_json none;
    for (const StudyKey& key : study_keys()) {
        if (key.in_quick) {
            properties[key.name] = described(key, schema_of(key, {}, none));
        }
    }
    ordered_json views = section(properties, {});
    add_exclusion(views);
    return views;
}

} // namespace

void add_study_schema(ordered_json& document, const std::vector<KeyDoc>& keys) {
    ordered_json& definitions = document["$defs"];
    ordered_json& named = definitions["named-design"]; // a file that is included may have the name
    named["allOf"] = ordered_json::array({schema_reference("design")});
    named["anyOf"] = {{{"required", {"name"}}}, {{"required", {"include"}}}};
    ordered_json properties;
    properties["include"] = schema_reference("include");
    for (const StudyKey& key : study_keys()) {
        properties[key.name] = described(key, schema_of(key, keys, definitions));
    }
    document.update(section(properties, {}));
    add_exclusion(document);
    document["oneOf"] = {{{"required", {"designs"}}}, {{"required", {"points"}}}};
}

} // namespace degs::sim
