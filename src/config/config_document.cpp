// SPDX-License-Identifier: Apache-2.0
#include "config/config_document.hpp"

#include <cmath>

#include "base/json_text.hpp"
#include "config/config_words.hpp"

namespace degs {
namespace {

using nlohmann::ordered_json;

/// JSON strings are YAML strings in double quotes. Bytes that are not UTF-8 become U+FFFD.
std::string quoted_text(const std::string& text) {
    return dump_json(ordered_json(text));
}

/// Words without quotes that readers of YAML 1.1 take for true or false.
bool is_truth_of_yaml(const std::string& word) {
    return word == "on" || word == "off" || word == "yes" || word == "no";
}

std::vector<std::string> words(const std::vector<const char*>& names) {
    return {names.begin(), names.end()};
}

/// Turns the typed calls of `describe` into one: a key with its document row and its JSON value.
class Lister : public ConfigVisitor {
public:
    using ConfigVisitor::choice;
    using ConfigVisitor::integer;

    void integer(const char* key, std::int64_t& value, std::int64_t low, std::int64_t high,
                 const char* doc) override {
        leaf(key, {"", "integer", std::to_string(value), config_words::range(low, high), doc},
             value);
    }
    void real(const char* key, double& value, double low, double high, const char* doc) override {
        leaf(key, {"", "real", config_words::number(value), config_words::range(low, high), doc},
             value);
    }
    void boolean(const char* key, bool& value, const char* doc) override {
        leaf(key, {"", "boolean", value ? "true" : "false", "true, false", doc}, value);
    }
    void text(const char* key, std::string& value, const char* doc) override {
        leaf(key, {"", "text", quoted_text(value), "any", doc}, value);
    }
    void choice(const char* key, int& value, const std::vector<const char*>& names,
                const char* doc) override {
        const std::string name = names.at(value);
        leaf(key, {"", "choice", name, config_words::list(words(names)), doc}, name);
    }

protected:
    virtual void leaf(const char* key, KeyDoc row, const ordered_json& value) = 0;
};

class JsonLister : public Lister {
public:
    bool visits_unused() const override { return false; }
    void begin_section(const char* key, const char*) override {
        open_.push_back(&(*open_.back())[key]);
        *open_.back() = ordered_json::object();
    }
    void end_section() override { open_.pop_back(); }
    ordered_json root = ordered_json::object();

private:
    void leaf(const char* key, KeyDoc, const ordered_json& value) override {
        (*open_.back())[key] = value;
    }
    std::vector<ordered_json*> open_{&root};
};

class YamlLister : public Lister {
public:
    bool visits_unused() const override { return false; }
    void begin_section(const char* key, const char* doc) override {
        line(std::string(key) + ":", doc);
        ++depth_;
    }
    void end_section() override { --depth_; }
    std::string yaml;

private:
    void leaf(const char* key, KeyDoc row, const ordered_json&) override {
        const bool quoted = row.type == "choice" && is_truth_of_yaml(row.default_value);
        line(std::string(key) + ": " +
                 (quoted ? quoted_text(row.default_value) : row.default_value),
             row.doc);
    }
    void line(const std::string& setting, const std::string& doc) {
        yaml += std::string(2 * depth_, ' ') + setting + (doc.empty() ? "" : "  # " + doc) + "\n";
    }
    std::size_t depth_ = 0;
};

class DocLister : public Lister {
public:
    void begin_section(const char* key, const char* doc) override {
        path_.push_back(path(key));
        keys.push_back({path_.back(), "section", "", "", doc});
    }
    void end_section() override { path_.pop_back(); }
    void spelled(const char* /*key*/, const std::string& expression,
                 const std::string& allowed) override {
        keys.back().allowed = allowed;
        keys.back().spelling = "^(" + expression + ")$";
    }
    std::vector<KeyDoc> keys;

private:
    void leaf(const char* key, KeyDoc row, const ordered_json&) override {
        row.path = path(key);
        keys.push_back(std::move(row));
    }
    std::string path(const char* key) const { return config_words::join_path(path_.back(), key); }
    std::vector<std::string> path_{""};
};

std::string code(const std::string& text) {
    return text.empty() ? "" : "`" + config_words::markdown_cell(text) + "`";
}

} // namespace

nlohmann::ordered_json resolved_json(const Describe& describe) {
    JsonLister lister;
    describe(lister);
    return std::move(lister.root);
}

std::string resolved_yaml_text(const Describe& describe) {
    YamlLister lister;
    describe(lister);
    return std::move(lister.yaml);
}

std::vector<KeyDoc> document_keys(const Describe& describe) {
    DocLister lister;
    describe(lister);
    return std::move(lister.keys);
}

std::string markdown_allowed(const KeyDoc& key) {
    const std::string bounds = " to ";
    std::string allowed = key.allowed;
    const std::size_t at = allowed.find(bounds);
    if ((key.type == "integer" || key.type == "real") && at != std::string::npos) {
        allowed.replace(at, bounds.size(), "..");
    }
    return key.type == "text" && allowed == "any" ? key.type
           : key.type == "real"                   ? key.type + " " + allowed
                                                  : config_words::markdown_cell(allowed);
}

std::string markdown_table(const std::vector<KeyDoc>& keys) {
    std::string table = "| Key | Default | Allowed | Meaning |\n|---|---|---|---|\n";
    for (const KeyDoc& key : keys) {
        if (key.type == "section") {
            continue;
        }
        table += "| " + code(key.path) + " | " + code(key.default_value) + " | " +
                 markdown_allowed(key) + " | " + config_words::markdown_cell(key.doc) + " |\n";
    }
    return table;
}

} // namespace degs
