// SPDX-License-Identifier: Apache-2.0
#include "degs/design.hpp"

#include "baselines/accelerators.hpp"
#include "baselines/costs_of_others.hpp"
#include "config/config_source.hpp"
#include "config/key_value.hpp"
#include "config/key_walk.hpp"
#include "modules/kit/accelerator/render_engine.hpp"

namespace degs {

Design::Design() : model_(accelerator_kinds().front().make()) {}

Design::Design(const Design& other)
    : warnings(other.warnings), kind_(other.kind_), model_(other.model_->clone()) {}

Design& Design::operator=(const Design& other) {
    warnings = other.warnings;
    kind_ = other.kind_;
    model_ = other.model_->clone();
    return *this;
}

Design::Design(Design&& other) noexcept = default;
Design& Design::operator=(Design&& other) noexcept = default;
Design::~Design() = default;

const std::string& Design::name() const {
    return model_->name;
}

int Design::pes() const {
    return model_->pes();
}

const AcceleratorConfig& Design::accelerator() const {
    return *model_;
}

std::string Design::problem() const {
    return model_->problem();
}

void Design::scale_to(int pes) {
    model_->scale_to(pes);
}

std::vector<std::string> Design::set(const std::vector<std::string>& assignments) {
    return ConfigSource::from_overrides(assignments).load(*this);
}

std::string Design::get(const std::string& key) const {
    KeyValue wanted(key);
    Design(*this).visit(wanted);
    return wanted.value();
}

void Design::visit(KeyVisitor& visitor) {
    Design changed = *this; // a visitor that throws changes nothing
    KeyWalk walk(visitor);
    changed.describe(walk);
    *this = std::move(changed);
}

std::string Design::kind() const {
    return accelerator_kinds()[kind_].name;
}

void Design::describe(ConfigVisitor& visitor) {
    std::vector<const char*> names;
    for (const AcceleratorKind& kind : accelerator_kinds()) {
        names.push_back(kind.name);
    }
    const int before = kind_;
    visitor.choice("accelerator", kind_, names, "which accelerator the other keys mean");
    if (kind_ != before) {
        model_ = accelerator_kinds()[kind_].make();
    }
    model_->describe(visitor);
    // A file of cost constants has the rows of all accelerators.
    visitor.of_others("cost", names, "it belongs to another accelerator");
}

Design load_design(const std::string& file, const std::vector<std::string>& overrides) {
    Design design;
    const ConfigSource source = ConfigSource::from_file(file, overrides);
    design.warnings = source.load(design);
    check_costs_of_others(source, design);
    return design;
}

} // namespace degs
