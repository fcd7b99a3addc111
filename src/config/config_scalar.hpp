// SPDX-License-Identifier: Apache-2.0
// Text of a configuration into values, strictly. A kind says what is allowed and reads it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/config_tree.hpp"

namespace degs::config_scalar {

// Each kind has three functions:
// * read(): the value; empty if the node is not of the kind
// * values(): the range or the choices, for documentation
// * allowed(): the same for the sentence "..., but must be <allowed>"

struct Integer {
    std::int64_t low, high;
    std::optional<std::int64_t> read(const ConfigNode& node) const;
    std::string values() const;
    std::string allowed(const ConfigNode& node) const;
};

struct Real {
    double low, high;
    std::optional<double> read(const ConfigNode& node) const;
    std::string values() const;
    std::string allowed(const ConfigNode& node) const;
};

struct Boolean {
    std::optional<bool> read(const ConfigNode& node) const;
    std::string values() const { return "true, false"; }
    std::string allowed(const ConfigNode&) const { return "true or false"; }
};

struct Text {
    std::optional<std::string> read(const ConfigNode& node) const;
    std::string values() const { return "any"; }
    std::string allowed(const ConfigNode&) const { return "a text (\"\" for an empty one)"; }
};

/// The value is the index of the name.
struct Choice {
    const std::vector<const char*>& names;
    /// Description of the key; in "name: meaning; ..." a word of a meaning suggests its name.
    const char* doc = "";
    std::optional<int> read(const ConfigNode& node) const;
    std::string values() const;
    std::string allowed(const ConfigNode& node) const;
};

/// Throws InputError with "<place>: key '<path>' is '<value>', but must be <allowed>."
[[noreturn]] void reject(const ConfigNode& node, const std::string& path,
                         const std::string& allowed);

template <class Kind>
auto value_of(const Kind& kind, const ConfigNode& node, const std::string& path) {
    const auto value = kind.read(node);
    if (!value) {
        reject(node, path, kind.allowed(node));
    }
    return *value;
}

} // namespace degs::config_scalar
