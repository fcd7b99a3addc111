// SPDX-License-Identifier: Apache-2.0
#include "sim/view/frame_kind.hpp"

namespace degs::sim {

RuleKind rule_kind(const ProjectionOptions& options) {
    return {options.order,      options.compensated, options.dilation, options.cut,
            options.near_plane, options.rule,        options.lens,     options.sigma.alpha,
            options.sigma.beta, options.sigma.kappa};
}

std::pair<int, TileMode> image_tiles(const FrameWorkload& frame) {
    const bool any = lists_whole_ellipse(frame.tile_mode) && frame.camera.hole.empty();
    return any ? std::pair(0, TileMode::Exact) : std::pair(frame.tile_size, frame.tile_mode);
}

FrameKind frame_kind(const AcceleratorConfig& config, const SceneTraits& traits) {
    const ProjectionOptions rules = projection_of(config.data_path(), traits.antialiased);
    return {rule_kind(rules), rules.numbers.is_reference() ? "" : rules.numbers.name(),
            config.tile_size_px(), config.tile_mode()};
}

} // namespace degs::sim
