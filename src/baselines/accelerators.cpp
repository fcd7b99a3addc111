// SPDX-License-Identifier: Apache-2.0
#include "baselines/accelerators.hpp"

#include <stdexcept>
#include <string>

#include "baselines/gbu/config.hpp"
#include "baselines/gcc/config.hpp"
#include "baselines/gscore/config.hpp"
#include "baselines/orange/config.hpp"
#include "modules/degs/config.hpp"

namespace degs {
namespace {

template <class Config>
std::unique_ptr<AcceleratorConfig> make() {
    return std::make_unique<Config>();
}

std::vector<AcceleratorKind>& kinds() {
    static std::vector<AcceleratorKind> kinds{
        {"degs", &make<DegsConfig>}, {"gscore", &make<gscore::Config>}, {"gbu", &make<gbu::Config>},
        {"gcc", &make<gcc::Config>}, {"orange", &make<orange::Config>},
    };
    return kinds;
}

} // namespace

const std::vector<AcceleratorKind>& accelerator_kinds() {
    return kinds();
}

void add_accelerator(const AcceleratorKind& kind) {
    for (const AcceleratorKind& known : kinds()) {
        if (std::string(known.name) == kind.name) {
            throw std::logic_error("There is an accelerator named '" + std::string(kind.name) +
                                   "' already.");
        }
    }
    kinds().push_back(kind);
}

} // namespace degs
