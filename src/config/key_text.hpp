// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "config/key_walk.hpp"
#include "config/written_values.hpp"

namespace degs {

/// Writes keys with their values, real numbers by their bits, which no rounding makes equal.
class KeyText : public WrittenValues {
public:
    const std::string& text() const { return text_; }
    void real(const std::string& path, double& value, double low, double high,
              const std::string& doc) override;

private:
    void see(const std::string& path, const std::string& value) override;

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
