// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "modules/kit/accelerator/render_engine.hpp"

namespace degs {

/// One kind of accelerator that a configuration file may name.
struct AcceleratorKind {
    const char* name;
    std::unique_ptr<AcceleratorConfig> (*make)(); ///< with default values
};

/// Every accelerator of this project, DeGS first, and then those that add_accelerator() has added.
const std::vector<AcceleratorKind>& accelerator_kinds();

/// Makes `accelerator: NAME` in a configuration file mean this kind, from now on. Throws
/// std::logic_error if the name is taken.
void add_accelerator(const AcceleratorKind& kind);
template <class Config>
void add_accelerator(const char* name) {
    add_accelerator(
        {name, []() -> std::unique_ptr<AcceleratorConfig> { return std::make_unique<Config>(); }});
}

} // namespace degs
