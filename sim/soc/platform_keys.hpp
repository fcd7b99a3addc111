// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/config_source.hpp"
#include "sim/design/run_config.hpp"

namespace degs::sim {

/// Finds keys of a design that have no effect on a platform, because the platform has its own
/// memory, renders one frame at a time, keeps the scene as floats, or bills nothing. Throws
/// InputError, one sentence, if an override sets such a key. Returns the warnings of `config` that
/// also hold on a platform, and one for each such key that a file sets to another value than its
/// default. `config` is what `source` describes. `has_views`: a frame has several.
std::vector<std::string> check_platform_keys(const ConfigSource& source, const RunConfig& config,
                                             bool has_views);

} // namespace degs::sim
