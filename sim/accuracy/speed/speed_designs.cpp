// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "config/config_document.hpp"
#include "degs/error.hpp"
#include "sim/accuracy/speed/speed.hpp"
#include "splat/pixels/data_path.hpp"

namespace degs::sim {
namespace {

const std::string kFormats = "pipeline.formats.";
const std::string kOfTheSet = "set";

/// The keys by which a design changes single formats of its number set.
std::vector<std::string> changed_formats(const RunConfig& config) {
    RunConfig copy = config;
    std::vector<std::string> paths;
    for (const KeyDoc& key : document_keys([&copy](ConfigVisitor& v) { copy.describe(v); })) {
        if (key.path.compare(0, kFormats.size(), kFormats) == 0 && key.type != "section" &&
            key.default_value.find(kOfTheSet) == std::string::npos) {
            paths.push_back(key.path);
        }
    }
    return paths;
}

/// An override of one design among several.
std::string addressed(std::string design, const std::string& path, const std::string& value) {
    return design.append(":").append(path).append("=").append(value);
}

std::string set_of_design(const RunConfig& config) {
    const std::string changed = changed_formats(config).empty() ? "" : " *";
    return name_of(config.accelerator().data_path().numbers) + changed;
}

} // namespace

SpeedFidelity speed_fidelity(const std::string& name) {
    SpeedFidelity fidelity;
    fidelity.name = name;
    const std::string within = "within:";
    if (name.compare(0, within.size(), within) == 0) {
        fidelity.sampling = parse_within(name.substr(within.size()));
        return fidelity;
    }
    fidelity.analytic = name == "analytic";
    if (fidelity.analytic) {
        return fidelity;
    }
    fidelity.sampling = parse_sampled(name);
    fidelity.fidelity = name == "strict" ? Fidelity::Strict : Fidelity::Exact;
    return fidelity;
}

std::vector<SpeedDesign> speed_designs(const std::vector<std::string>& configs,
                                       const std::vector<std::string>& overrides,
                                       const std::vector<std::string>& numbers,
                                       const std::string& memory) {
    std::vector<SpeedDesign> designs;
    const std::vector<NamedConfig> own = load_configs(configs, overrides, memory);
    for (std::size_t c = 0; c < own.size(); ++c) {
        const std::string own_set = set_of_design(own[c].config);
        std::vector<std::string> sets{"ideal"};
        for (const std::string& set :
             numbers.empty() ? std::vector<std::string>{"fp32", own_set} : numbers) {
            if (std::find(sets.begin(), sets.end(), set) == sets.end()) {
                sets.push_back(set);
            }
        }
        for (const std::string& set : sets) {
            std::vector<std::string> changes = overrides;
            if (set != own_set) {
                changes.push_back(addressed(own[c].name, "pipeline.numbers", set));
                for (const std::string& path : changed_formats(own[c].config)) {
                    changes.push_back(addressed(own[c].name, path, kOfTheSet));
                }
            }
            designs.push_back({own[c].name, set, load_configs(configs, changes, memory)[c].config});
        }
    }
    return designs;
}

} // namespace degs::sim
