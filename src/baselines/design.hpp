// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "modules/kit/accelerator/render_engine.hpp"

namespace degs {

/// What a configuration file describes: the kind of accelerator, then the keys of that kind.
class Design {
public:
    /// The first of accelerator_kinds() with its defaults.
    Design();
    Design(const Design& other)
        : warnings(other.warnings), kind_(other.kind_), model_(other.model_->clone()) {}
    Design& operator=(const Design& other) {
        warnings = other.warnings;
        kind_ = other.kind_;
        model_ = other.model_->clone();
        return *this;
    }
    ~Design() = default;

    /// One sentence for each key that was set and has no effect.
    std::vector<std::string> warnings;

    const AcceleratorConfig& accelerator() const { return *model_; }
    /// See AcceleratorConfig::scale_to.
    void scale_to(int pes) { model_->scale_to(pes); }
    /// The name of this kind of accelerator in a file, e.g. "degs".
    std::string kind() const;

    void describe(ConfigVisitor& visitor);
    /// See AcceleratorConfig::problem.
    std::string problem() const { return model_->problem(); }

private:
    int kind_ = 0; // into accelerator_kinds()
    std::unique_ptr<AcceleratorConfig> model_;
};

/// Reads a configuration file (docs/configuration.md) of any accelerator, for degs::Accelerator:
///     degs::Accelerator accelerator("accelerator", degs::load_design("degs-64.yaml").accelerator());
/// `overrides` are "path.to.key=value". Throws InputError, one sentence that names the file and the
/// line, for a file that cannot be read and for every key or value that is wrong.
Design load_design(const std::string& file, const std::vector<std::string>& overrides = {});

} // namespace degs
