// SPDX-License-Identifier: Apache-2.0
#include "config/config_changes.hpp"

#include <map>

#include "config/config_scalar.hpp"
#include "config/config_words.hpp"

namespace degs {
namespace {

constexpr const char* kUnchanged = "set";

/// Changes and refuses nothing.
class SilentVisitor final : public ConfigVisitor {
public:
    void begin_section(const char*, const char*) override {}
    void end_section() override {}
    void integer(const char*, std::int64_t&, std::int64_t, std::int64_t, const char*) override {}
    void real(const char*, double&, double, double, const char*) override {}
    void boolean(const char*, bool&, const char*) override {}
    void text(const char*, std::string&, const char*) override {}
    void choice(const char*, int&, const std::vector<const char*>&, const char*) override {}
};

} // namespace

/// Offers every key to `outer` as a text, and reads what is not `set` as the kind it really is.
class ConfigChanges::Keys : public ConfigVisitor {
public:
    using ConfigVisitor::choice;
    using ConfigVisitor::integer;

    Keys(ConfigVisitor& outer, Changes& changes) : outer_(outer), changes_(changes) {}

    void begin_section(const char* key, const char* doc) override {
        outer_.begin_section(key, doc);
        path_.push_back(path_of(key));
    }
    void end_section() override {
        path_.pop_back();
        outer_.end_section();
    }
    void integer(const char* key, std::int64_t& value, std::int64_t low, std::int64_t high,
                 const char* doc) override {
        change(key, value, config_scalar::Integer{low, high}, doc);
    }
    void real(const char* key, double& value, double low, double high, const char* doc) override {
        change(key, value, config_scalar::Real{low, high}, doc);
    }
    void boolean(const char* key, bool& value, const char* doc) override {
        change(key, value, config_scalar::Boolean{}, doc);
    }
    void text(const char* key, std::string& value, const char* doc) override {
        standing_[path_of(key)] = value;
        change(key, value, config_scalar::Text{}, doc);
    }
    void spelled(const char* key, const std::string& expression) override {
        outer_.spelled(key, kUnchanged + ("|" + expression));
    }
    void choice(const char* key, int& value, const std::vector<const char*>& names,
                const char* doc) override {
        change(key, value, config_scalar::Choice{names, doc}, doc);
    }
    bool visits_unused() const override { return outer_.visits_unused(); }
    /// Where the key is a text that stays as it is, the rule says what that is.
    void require(bool holds, const ConfigRule& rule) override {
        ConfigRule told = rule;
        const std::string path = path_of(rule.key);
        const auto standing = standing_.find(path);
        if (standing != standing_.end() && changed(path) == nullptr) {
            told.rule += " (" + std::string(kUnchanged) + " is " + standing->second + ")";
        }
        outer_.require(holds, told);
    }

private:
    template <class Value, class Kind>
    void change(const char* key, Value& value, const Kind& kind, const std::string& doc) {
        const std::string values = kind.values();
        const std::string text = asked(key, values == "any" ? doc : values + ": " + doc);
        if (text == kUnchanged) {
            return;
        }
        ConfigNode node;
        node.kind = ConfigNode::Kind::kScalar;
        node.text = text;
        const auto read = kind.read(node);
        value = read.value_or(value);
        outer_.require(read.has_value(), {key, "must be " + kind.allowed(node) + ", or set", ""});
    }
    /// The text of a key after `outer` has seen it; remembered if it is a change.
    std::string asked(const char* key, const std::string& doc) {
        const std::string path = path_of(key);
        std::string* const known = changed(path);
        std::string text = known == nullptr ? kUnchanged : *known;
        outer_.text(key, text, doc.c_str());
        if (known != nullptr) {
            *known = text;
        } else if (text != kUnchanged) {
            changes_.emplace_back(path, text);
        }
        return text;
    }
    std::string* changed(const std::string& path) {
        for (auto& [key, value] : changes_) {
            if (key == path) {
                return &value;
            }
        }
        return nullptr;
    }
    std::string path_of(const char* key) const {
        return config_words::join_path(path_.back(), key);
    }

    ConfigVisitor& outer_;
    Changes& changes_;
    std::map<std::string, std::string> standing_; // texts of the struct as they are, by path
    std::vector<std::string> path_{""};
};

std::unique_ptr<ConfigVisitor> ConfigChanges::silent_visitor() {
    return std::make_unique<SilentVisitor>();
}

std::unique_ptr<ConfigVisitor> ConfigChanges::keys_for(ConfigVisitor& visitor) {
    return std::make_unique<Keys>(visitor, changes_);
}

std::vector<std::string> ConfigChanges::assignments() const {
    std::vector<std::string> list;
    for (const auto& [path, value] : changes_) {
        if (value != kUnchanged) {
            list.push_back(path);
            list.back().append("=").append(value);
        }
    }
    return list;
}

} // namespace degs
