// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.hpp"
#include "degs/options.hpp"

namespace degs {

/// All options but the timeline as keys, see ConfigVisitor.
void describe(AcceleratorOptions& options, ConfigVisitor& visitor);

} // namespace degs
