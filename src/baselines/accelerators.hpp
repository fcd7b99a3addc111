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

/// Every accelerator of this project; DeGS first.
const std::vector<AcceleratorKind>& accelerator_kinds();

} // namespace degs
