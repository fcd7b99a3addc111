// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation/frame_kind.hpp"

namespace degs::sim {

RuleKind rule_kind(const ProjectionOptions& options) {
    return {options.order,      options.compensated, options.dilation, options.cut,
            options.near_plane, options.rule,        options.lens,     options.sigma.alpha,
            options.sigma.beta, options.sigma.kappa};
}

FrameKind frame_kind(const AcceleratorConfig& config, const SceneTraits& traits) {
    const ProjectionOptions rules = projection_of(config.data_path(), traits.antialiased);
    return {rule_kind(rules), rules.numbers.is_reference() ? "" : rules.numbers.name(),
            config.tile_size_px(), config.tile_mode()};
}

} // namespace degs::sim
