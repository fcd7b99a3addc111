// SPDX-License-Identifier: Apache-2.0
#include "baselines/accelerators.hpp"

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

} // namespace

const std::vector<AcceleratorKind>& accelerator_kinds() {
    static const std::vector<AcceleratorKind> kinds{
        {"degs", &make<DegsConfig>}, {"gscore", &make<gscore::Config>}, {"gbu", &make<gbu::Config>},
        {"gcc", &make<gcc::Config>}, {"orange", &make<orange::Config>},
    };
    return kinds;
}

} // namespace degs
