// SPDX-License-Identifier: Apache-2.0
// The rules by which commands without a configuration draw; those of designs are keys of
// pipeline.rules.
#pragma once

#include <CLI/App.hpp>

#include "splat/frame/rendering_rules.hpp"

namespace degs::sim {

/// Adds --near, the near plane.
CLI::Option* add_near_option(CLI::App& command, double& near);

/// Adds --projection and --lens.
void add_projection_options(CLI::App& command, RenderingRules& rules);

/// Adds --rules, where all of them start, and an option for each.
void add_rule_options(CLI::App& command, RenderingRules& rules);

} // namespace degs::sim
