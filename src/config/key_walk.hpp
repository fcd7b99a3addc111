// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "degs/keys.hpp"

namespace degs {

/// Tells a KeyVisitor the keys of a struct that describes itself, by their whole names.
class KeyWalk : public ConfigVisitor {
public:
    explicit KeyWalk(KeyVisitor& visitor) : visitor_(visitor) {}

    using ConfigVisitor::choice;
    using ConfigVisitor::integer;
    void begin_section(const char* key, const char* /*doc*/) override {
        sections_.push_back(path_of(key) + ".");
    }
    void end_section() override { sections_.pop_back(); }
    void integer(const char* key, std::int64_t& value, std::int64_t low, std::int64_t high,
                 const char* doc) override {
        visitor_.integer(path_of(key), value, low, high, doc);
    }
    void real(const char* key, double& value, double low, double high, const char* doc) override {
        visitor_.real(path_of(key), value, low, high, doc);
    }
    void boolean(const char* key, bool& value, const char* doc) override {
        visitor_.boolean(path_of(key), value, doc);
    }
    void text(const char* key, std::string& value, const char* doc) override {
        visitor_.text(path_of(key), value, doc);
    }
    ConfigOrigin origin(const char* key) const override {
        return {"key " + config_words::quote(path_of(key)), ""};
    }
    void choice(const char* key, int& value, const std::vector<const char*>& names,
                const char* doc) override {
        visitor_.choice(path_of(key), value, {names.begin(), names.end()}, doc);
        if (value < 0 || std::size_t(value) >= names.size()) {
            throw InputError("key " + config_words::quote(path_of(key)) + " is choice " +
                             std::to_string(value) + ", but must be one of 0 to " +
                             std::to_string(names.size() - 1) + ".");
        }
    }

private:
    std::string path_of(const char* key) const {
        return sections_.empty() ? key : sections_.back() + key;
    }

    KeyVisitor& visitor_;
    std::vector<std::string> sections_; // with a dot behind each
};

} // namespace degs
