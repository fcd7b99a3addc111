// SPDX-License-Identifier: Apache-2.0
#include "sim/run_config.hpp"

#include "baselines/accelerators.hpp"
#include "tlm/config_source.hpp"

namespace degs::sim {

RunConfig::RunConfig() : model_(accelerator_kinds().front().make()) {}

void RunConfig::describe(ConfigVisitor& visitor) {
    std::vector<const char*> names;
    for (const AcceleratorKind& kind : accelerator_kinds()) {
        names.push_back(kind.name);
    }
    const int before = kind_;
    visitor.choice("accelerator", kind_, names, "which accelerator the other keys mean");
    if (kind_ != before) {
        model_ = accelerator_kinds()[static_cast<std::size_t>(kind_)].make();
    }
    model_->describe(visitor);
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
