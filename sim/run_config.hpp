// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "modules/degs_config.hpp"

namespace degs::sim {

/// Which accelerator a configuration file describes. Another one joins by a name in
/// RunConfig::describe, its configuration beside `degs`, and a row in run_accelerator().
enum class AcceleratorKind { Degs };

/// A configuration file: the kind of accelerator, then the keys of that kind.
struct RunConfig {
    AcceleratorKind accelerator = AcceleratorKind::Degs;
    DegsConfig degs;

    void describe(ConfigVisitor& visitor);
    /// What single ranges cannot check; one sentence or empty.
    std::string problem() const { return degs.problem(); }
};

/// Reads and checks a file with `--set` overrides. Throws ConfigError.
RunConfig load_run_config(const std::string& file, const std::vector<std::string>& overrides);

} // namespace degs::sim
