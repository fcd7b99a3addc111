// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/config_source.hpp"
#include "sim/simulation/run_config.hpp"

namespace degs::sim {

/// The keys of a design that have no part in a frame on a platform: what the platform has itself,
/// what only several frames have, and what only reports of degs run show. Throws InputError, one
/// sentence, if an override gives one; returns a sentence for each that a file sets to another
/// value than its default, behind those of `config` that hold on a platform, too. `config` is what
/// `source` describes.
std::vector<std::string> check_platform_keys(const ConfigSource& source, const RunConfig& config);

} // namespace degs::sim
