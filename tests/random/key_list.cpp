// SPDX-License-Identifier: Apache-2.0
#include "tests/random/key_list.hpp"

namespace degs::trials {
namespace {

class KeyCollector : public ConfigVisitor {
public:
    using ConfigVisitor::choice;
    using ConfigVisitor::integer;

    void begin_section(const char* key, const char*) override { open_.push_back(path_of(key)); }
    void end_section() override { open_.pop_back(); }
    void integer(const char* key, std::int64_t& value, std::int64_t low, std::int64_t high,
                 const char* doc) override {
        add(key, Key::Kind::Integer, doc);
        keys.back().low = static_cast<double>(low);
        keys.back().high = static_cast<double>(high);
        keys.back().value = static_cast<double>(value);
    }
    void real(const char* key, double& value, double low, double high, const char* doc) override {
        add(key, Key::Kind::Real, doc);
        keys.back().low = low;
        keys.back().high = high;
        keys.back().value = value;
    }
    void boolean(const char* key, bool&, const char* doc) override {
        add(key, Key::Kind::Word, doc);
        keys.back().words = {"true", "false"};
    }
    void text(const char* key, std::string&, const char* doc) override {
        add(key, Key::Kind::Text, doc);
    }
    void choice(const char* key, int&, const std::vector<const char*>& names,
                const char* doc) override {
        add(key, Key::Kind::Word, doc);
        keys.back().words.assign(names.begin(), names.end());
    }

    std::vector<Key> keys;

private:
    std::string path_of(const char* key) const {
        return open_.empty() ? key : open_.back() + "." + key;
    }
    void add(const char* key, Key::Kind kind, const char* doc) {
        Key found;
        found.path = path_of(key);
        found.kind = kind;
        found.doc = doc;
        keys.push_back(std::move(found));
    }

    std::vector<std::string> open_;
};

} // namespace

std::vector<Key> keys_of(sim::RunConfig config) {
    KeyCollector collector;
    config.describe(collector);
    return collector.keys;
}

std::vector<Key> keys_of(NumberSet set) {
    KeyCollector collector;
    set.describe(collector);
    return collector.keys;
}

} // namespace degs::trials
