// SPDX-License-Identifier: Apache-2.0
#include "sim/run_config.hpp"

#include "tlm/config_source.hpp"

namespace degs::sim {

void RunConfig::describe(ConfigVisitor& visitor) {
    visitor.choice("accelerator", accelerator, {"degs"}, "which accelerator the other keys mean");
    degs.describe(visitor);
}

RunConfig load_run_config(const std::string& file, const std::vector<std::string>& overrides) {
    RunConfig config;
    ConfigSource::from_file(file, overrides).load(config);
    if (const std::string problem = config.problem(); !problem.empty()) {
        throw ConfigError(file + ": " + problem + ".");
    }
    return config;
}

} // namespace degs::sim
