// SPDX-License-Identifier: Apache-2.0
#include "baselines/costs_of_others.hpp"

#include "baselines/accelerators.hpp"

namespace degs {

void check_costs_of_others(const ConfigSource& source, const Design& design) {
    const ConfigNode* const cost = source.tree().find("cost");
    if (cost == nullptr) {
        return;
    }
    // The rules between a row and the leakage hold for the leakage of the run.
    const std::string leakage = "cost.leakage_mw_per_mm2";
    for (const AcceleratorKind& kind : accelerator_kinds()) {
        if (kind.name == design.kind() || cost->find(kind.name) == nullptr) {
            continue;
        }
        ConfigNode accelerator;
        accelerator.kind = ConfigNode::Kind::kScalar;
        accelerator.key = "accelerator";
        accelerator.text = kind.name;
        accelerator.place = cost->place;
        ConfigNode tree;
        tree.kind = ConfigNode::Kind::kSection;
        tree.children = {accelerator, *cost};
        Design other;
        ConfigSource::from_tree(tree, {leakage + "=" + design.get(leakage)}).load(other);
    }
}

} // namespace degs
