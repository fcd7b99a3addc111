// SPDX-License-Identifier: Apache-2.0
#include "config/config_schema.hpp"

#include <limits>

#include "config/quantity.hpp"

namespace degs {
namespace {

using nlohmann::ordered_json;

ordered_json empty_section(const char* doc) {
    ordered_json section = ordered_json::object();
    if (*doc != '\0') {
        section["description"] = doc;
    }
    section["type"] = {"object", "null"}; // a section whose lines are commented out is null
    section["properties"]["include"] = schema_reference("include");
    section["additionalProperties"] = false;
    return section;
}

/// Builds the schema of one section after the other. A bound at the end of its type is none, as in
/// config_words::range().
class SchemaBuilder : public ConfigVisitor {
public:
    using ConfigVisitor::choice;
    using ConfigVisitor::integer;

    void begin_section(const char* key, const char* doc) override {
        ordered_json& section = properties()[key];
        section = empty_section(doc);
        open_.push_back(&section);
    }
    void end_section() override { open_.pop_back(); }
    void integer(const char* key, std::int64_t& value, std::int64_t low, std::int64_t high,
                 const char* doc) override {
        using Wide = std::numeric_limits<std::int64_t>;
        using Narrow = std::numeric_limits<int>;
        ordered_json& leaf = number(key, "integer", doc);
        if (low != Wide::min() && low != Narrow::min()) {
            leaf["minimum"] = low;
        }
        if (high != Wide::max() && high != Narrow::max()) {
            leaf["maximum"] = high;
        }
        leaf["default"] = value;
    }
    void real(const char* key, double& value, double low, double high, const char* doc) override {
        using Limits = std::numeric_limits<double>;
        ordered_json& leaf = number(key, "number", doc);
        if (low > Limits::lowest()) {
            leaf["minimum"] = low;
        }
        if (high < Limits::max()) {
            leaf["maximum"] = high;
        }
        leaf["default"] = value;
    }
    void boolean(const char* key, bool& value, const char* doc) override {
        leaf(key, doc, {{"type", "boolean"}, {"default", value}});
    }
    /// To YAML an unquoted 28 is a number, and here it is a text like any other scalar.
    void text(const char* key, std::string& value, const char* doc) override {
        leaf(key, doc, {{"type", {"string", "number", "boolean"}}, {"default", value}});
    }
    void spelled(const char* key, const std::string& expression,
                 const std::string& /*allowed*/) override {
        ordered_json& leaf = properties()[key];
        leaf["type"] = "string";
        leaf["pattern"] = "^(" + expression + ")$";
    }
    void choice(const char* key, int& value, const std::vector<const char*>& names,
                const char* doc) override {
        leaf(key, doc, {{"enum", names}, {"default", names.at(value)}});
    }
    void of_others(const char* section, const std::vector<const char*>& keys,
                   const char* reason) override {
        if (!properties().contains(section)) {
            return;
        }
        ordered_json& known = properties()[section]["properties"];
        for (const char* key : keys) {
            if (!known.contains(key)) {
                known[key] = {{"description", std::string("has no effect, because ") + reason},
                              {"type", {"object", "null"}}};
            }
        }
    }

    ordered_json root = empty_section("");

private:
    ordered_json& properties() { return (*open_.back())["properties"]; }
    ordered_json& leaf(const char* key, const char* doc, const ordered_json& what) {
        ordered_json& place = properties()[key];
        place = {{"description", doc}};
        place.update(what);
        return place;
    }
    /// A number, or where the sentence of the key begins with a unit, a text such as "8KB".
    ordered_json& number(const char* key, const char* type, const char* doc) {
        const std::vector<std::string> units = units_of({key, doc});
        if (units.empty()) {
            return leaf(key, doc, {{"type", type}});
        }
        return leaf(key, doc,
                    {{"type", {type, "string"}}, {"pattern", "^" + quantity_pattern(units) + "$"}});
    }

    std::vector<ordered_json*> open_{&root}; // objects keep their places: only the last one grows
};

} // namespace

ordered_json include_schema() {
    const ordered_json file{{"type", "string"}, {"minLength", 1}};
    return {{"description", "the first key of a section: files, relative to this one, whose keys "
                            "come first"},
            {"anyOf", {file, {{"type", "array"}, {"items", file}, {"minItems", 1}}}}};
}

ordered_json schema_reference(const std::string& definition) {
    return {{"$ref", "#/$defs/" + definition}};
}

ordered_json schema_json(const Describe& describe) {
    SchemaBuilder builder;
    describe(builder);
    return std::move(builder.root);
}

std::string number_pattern() {
    return "-?((0|[1-9][0-9]*)(\\.[0-9]*)?|\\.[0-9]+)";
}

std::string quantity_pattern(const std::vector<std::string>& units) {
    std::string names;
    for (const std::string& unit : units) {
        names += (names.empty() ? "" : "|") + unit;
    }
    return units.empty() ? "" : number_pattern() + " *(" + names + ")";
}

} // namespace degs
