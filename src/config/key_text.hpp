// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "config/key_walk.hpp"

namespace degs {

/// Writes keys with their values.
class KeyText : public KeyVisitor {
public:
    const std::string& text() const { return text_; }
    void integer(const std::string& path, std::int64_t& value, std::int64_t low, std::int64_t high,
                 const std::string& doc) override;
    void real(const std::string& path, double& value, double low, double high,
              const std::string& doc) override;
    void boolean(const std::string& path, bool& value, const std::string& doc) override;
    void text(const std::string& path, std::string& value, const std::string& doc) override;
    void choice(const std::string& path, int& value, const std::vector<std::string>& names,
                const std::string& doc) override;

private:
    void add(const std::string& path, const std::string& value);

    std::string text_;
};

/// The keys of a struct that describes itself, with their values: structs with equal texts are
/// equal.
template <class Described>
std::string key_text(Described described) {
    KeyText text;
    KeyWalk walk(text);
    described.describe(walk);
    return text.text();
}

} // namespace degs
