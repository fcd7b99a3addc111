// SPDX-License-Identifier: Apache-2.0
#include "baselines/design.hpp"

#include "baselines/accelerators.hpp"
#include "config/config_source.hpp"

namespace degs {

Design::Design() : model_(accelerator_kinds().front().make()) {}

std::string Design::kind() const {
    return accelerator_kinds()[kind_].name;
}

void Design::describe(ConfigVisitor& visitor) {
    std::vector<const char*> names;
    for (const AcceleratorKind& kind : accelerator_kinds()) {
        names.push_back(kind.name);
    }
    const int before = kind_;
    visitor.choice("accelerator", kind_, names, "which accelerator the other keys mean");
    if (kind_ != before) {
        model_ = accelerator_kinds()[kind_].make();
    }
    model_->describe(visitor);
    // A file of cost constants has the rows of all accelerators.
    visitor.of_others("cost", names, "it belongs to another accelerator");
}

Design load_design(const std::string& file, const std::vector<std::string>& overrides) {
    Design design;
    design.warnings = ConfigSource::from_file(file, overrides).load(design);
    return design;
}

} // namespace degs
