// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "degs/error.hpp"
#include "sim/accuracy/speed/speed.hpp"

namespace degs::sim {

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
        const std::string own_set = own[c].config.get("pipeline.numbers");
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
                changes.push_back(own[c].name);
                changes.back().append(":pipeline.numbers=").append(set);
            }
            designs.push_back({own[c].name, set, load_configs(configs, changes, memory)[c].config});
        }
    }
    return designs;
}

} // namespace degs::sim
