// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "config/config_source.hpp"

namespace degs {

/// Fills a struct from a source, and remembers every key it was asked for, so that finish() can
/// reject the others and suggest the keys that may have been meant.
class ConfigReader : public ConfigVisitor {
public:
    using ConfigVisitor::choice;
    using ConfigVisitor::integer;

    explicit ConfigReader(const ConfigSource& source);

    void begin_section(const char* key, const char* doc) override;
    void end_section() override;
    void integer(const char* key, std::int64_t& value, std::int64_t low, std::int64_t high,
                 const char* doc) override;
    void real(const char* key, double& value, double low, double high, const char* doc) override;
    void boolean(const char* key, bool& value, const char* doc) override;
    void text(const char* key, std::string& value, const char* doc) override;
    ConfigOrigin origin(const char* key) const override;
    void replaced(const char* key, const char* advice) override;
    void choice(const char* key, int& value, const std::vector<const char*>& names,
                const char* doc) override;
    void require(bool holds, const ConfigRule& rule) override;
    void advise(bool in_proportion, const ConfigRule& rule) override;
    void advise_if_set(bool of_use, const ConfigRule& rule) override;
    void unused(const char* key, const char* decider, const char* reason) override;
    void of_others(const char* section, const std::vector<const char*>& keys,
                   const char* reason) override;

    /// Rejects keys that nobody asked for, then the first rule that does not hold.
    void finish() const;
    /// One sentence for every key that was given and has no effect.
    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    struct Section {
        std::string path;
        const ConfigNode* node = nullptr; // null when the file does not name it
    };

    std::string declare(const char* key);
    void note(const char* key, bool changed, const std::string& value);
    bool is_changed(const std::string& path) const;
    std::string path_of(const char* key) const;
    std::string sentence_of(const ConfigRule& rule) const;
    /// Calls `parse(node)` for the value of the file, then for that of the override; both must be
    /// valid.
    template <class Parse>
    bool each_value(const char* key, const Parse& parse);
    template <class Number>
    void check_standing(const std::string& path, Number value, Number low, Number high) const;
    bool is_of_others(const std::string& path) const;
    void reject_unknown(const ConfigNode& section, const std::string& path) const;
    void reject_unknown(const std::string& override_path, const std::string& place) const;
    [[noreturn]] void fail_unknown(const std::string& place, const std::string& section,
                                   const std::string& key) const;
    std::string guess(const std::string& section, const std::string& key) const;
    const std::string* advice_of(const std::string& path) const;

    const ConfigSource& source_;
    std::vector<Section> open_;
    std::map<std::string, std::vector<std::string>> known_; // keys by path of their section
    std::map<std::string, std::string> values_;             // as text, by path
    std::map<std::string, std::string> replaced_;           // advice by path
    std::vector<std::string> of_others_;                    // paths of sections
    std::set<std::string> changed_;                         // paths of values unlike the default
    std::string broken_rule_;                               // the sentence; empty while all hold
    std::vector<std::string> warnings_;
};

} // namespace degs
