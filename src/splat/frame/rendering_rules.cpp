// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/rendering_rules.hpp"

#include "config/config.hpp"

namespace degs {

namespace {

constexpr double kKhrCut = 9; ///< three standard deviations

} // namespace

const std::vector<const char*>& rule_set_names() {
    static const std::vector<const char*> names{"inria", "khr"};
    return names;
}

const std::vector<const char*>& splat_order_names() {
    static const std::vector<const char*> names{"depth", "distance"};
    return names;
}

const char* name_of(SplatOrder order) {
    return splat_order_names().at(static_cast<std::size_t>(order));
}

const std::vector<const char*>& antialiasing_names() {
    static const std::vector<const char*> names{"scene", "off", "on"};
    return names;
}

RenderingRules::RenderingRules(RuleSet set) : preset(set) {
    if (set == RuleSet::Khr) {
        order = SplatOrder::Distance;
        cut = kKhrCut;
    }
}

void RenderingRules::describe(ConfigVisitor& visitor) {
    RuleSet wanted = preset;
    visitor.choice("preset", wanted, rule_set_names(),
                   "where the other rules start; inria: reference code; khr: "
                   "KHR_gaussian_splatting, i.e. order: distance and cut: 9");
    if (wanted != preset) {
        *this = RenderingRules(wanted);
    }
    visitor.choice("order", order, splat_order_names(),
                   "order of blending; depth: view z (reference code, paper Sec. II-A); distance: "
                   "Euclidean, to the camera");
    visitor.choice("antialiasing", antialiasing, antialiasing_names(),
                   "opacity times sqrt(det before / det after the low-pass filter); scene: if the "
                   "file says that it was trained so");
    visitor.real("low_pass", low_pass, 0, 10,
                 "px^2 added to both variances of a splat; files of Mip-Splatting and Brush are "
                 "trained with 0.1");
    visitor.real("cut", cut, 0, kNoCut,
                 "squared Mahalanobis distance at which a splat ends; 12: where alpha falls below "
                 "1/255 (reference code); 9: KHR_gaussian_splatting");
    visitor.real(
        "near", near, 0, kFarthestNearPlane,
        "scene units; means at or before this view z are not drawn; gsplat trains with 0.01");
}

ProjectionOptions RenderingRules::options(bool antialiased,
                                          const ProjectionNumbers& numbers) const {
    ProjectionOptions options;
    options.dilation = low_pass;
    options.cut = cut;
    options.near_plane = near;
    options.order = order;
    options.compensated =
        antialiasing == Antialiasing::On || (antialiasing == Antialiasing::Scene && antialiased);
    options.numbers = numbers;
    return options;
}

} // namespace degs
