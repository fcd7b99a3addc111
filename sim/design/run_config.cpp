// SPDX-License-Identifier: Apache-2.0
#include "sim/design/run_config.hpp"

#include <algorithm>

#include "baselines/accelerators.hpp"
#include "baselines/costs_of_others.hpp"
#include "config/config_source.hpp"

namespace degs::sim {

namespace {

/// The section of `key` in `parent`, which is created if it does not exist.
ConfigNode& section_of(ConfigNode& parent, const std::string& key, const std::string& place) {
    for (ConfigNode& child : parent.children) {
        if (child.key == key) {
            return child;
        }
    }
    ConfigNode section;
    section.kind = ConfigNode::Kind::kSection;
    section.key = key;
    section.place = place;
    return parent.children.emplace_back(std::move(section));
}

} // namespace

void put_memory(ConfigNode& tree, const std::string& file) {
    if (file.empty()) {
        return;
    }
    const std::string place = "--memory " + file;
    ConfigNode& memory = section_of(tree, "memory", place);
    ConfigNode& model = section_of(memory, "model", place);
    model.layer = 0; // as with --set: it overrides the file's memory section
    model.kind = ConfigNode::Kind::kScalar;
    model.text = "lpddr5";
    ConfigNode& keys = section_of(memory, "lpddr5", place);
    keys.children = ConfigSource::from_file(file).tree().children;
}

RunConfig load_run_config(const std::string& file, const std::vector<std::string>& overrides,
                          const std::string& memory_file) {
    if (memory_file.empty()) {
        return load_run_config(ConfigSource::from_file(file, overrides));
    }
    ConfigNode tree = ConfigSource::from_file(file).tree();
    put_memory(tree, memory_file);
    return load_run_config(ConfigSource::from_tree(std::move(tree), overrides));
}

std::vector<std::string> accelerator_names() {
    std::vector<std::string> names;
    for (const AcceleratorKind& kind : accelerator_kinds()) {
        names.emplace_back(kind.name);
    }
    return names;
}

bool is_accelerator(const std::string& kind) {
    const std::vector<AcceleratorKind>& kinds = accelerator_kinds();
    return std::any_of(kinds.begin(), kinds.end(),
                       [&kind](const AcceleratorKind& known) { return known.name == kind; });
}

RunConfig default_run_config(const std::string& kind, const std::vector<std::string>& overrides) {
    ConfigNode tree;
    tree.kind = ConfigNode::Kind::kSection;
    ConfigNode& accelerator = section_of(tree, "accelerator", kind);
    accelerator.kind = ConfigNode::Kind::kScalar;
    accelerator.text = kind;
    return load_run_config(ConfigSource::from_tree(std::move(tree), overrides));
}

RunConfig sized_run_config(const std::string& kind, int pes,
                           const std::vector<std::string>& overrides) {
    RunConfig config = default_run_config(kind, {});
    config.scale_to(pes);
    config.warnings = ConfigSource::from_overrides(overrides).load(config);
    return config;
}

RunConfig load_run_config(const ConfigSource& source) {
    RunConfig config;
    config.warnings = source.load(config);
    check_costs_of_others(source, config);
    return config;
}

} // namespace degs::sim
