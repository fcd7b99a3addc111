// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "config/config.hpp"

namespace degs {

/// Changes to a struct that comes from elsewhere, as a section of a configuration: it has the keys
/// of the struct, but each is the text `set`, where the struct keeps its value, or a new value.
class ConfigChanges {
public:
    /// Describes the keys of `base` to the visitor and changes `base` accordingly; rules of `base`
    /// become rules of the section.
    template <class Config>
    void describe(ConfigVisitor& visitor, Config& base) {
        const std::unique_ptr<ConfigVisitor> keys = keys_for(visitor);
        base.describe(*keys);
    }
    /// `base` with the changes, as far as they are valid; describe() refuses the others.
    template <class Config>
    Config applied_to(Config base) const {
        ConfigChanges copy = *this;
        const std::unique_ptr<ConfigVisitor> nobody = silent_visitor();
        copy.describe(*nobody, base);
        return base;
    }
    /// The changes as "path.to.key=value", in the order of the keys.
    std::vector<std::string> assignments() const;

private:
    class Keys;
    using Changes = std::vector<std::pair<std::string, std::string>>; // path and value
    std::unique_ptr<ConfigVisitor> keys_for(ConfigVisitor& visitor);
    static std::unique_ptr<ConfigVisitor> silent_visitor();
    Changes changes_;
};

} // namespace degs
