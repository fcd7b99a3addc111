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

const std::vector<const char*>& projection_rule_names() {
    static const std::vector<const char*> names{"linear", "unscented"};
    return names;
}

const char* name_of(ProjectionRule rule) {
    return projection_rule_names().at(static_cast<std::size_t>(rule));
}

const std::vector<const char*>& lens_rule_names() {
    static const std::vector<const char*> names{"camera", "pinhole"};
    return names;
}

const char* name_of(LensRule rule) {
    return lens_rule_names().at(static_cast<std::size_t>(rule));
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
    visitor.choice("projection", projection, projection_rule_names(),
                   "linear: by the Jacobian of a pinhole (reference code, paper Eq. 1-3); "
                   "unscented: by seven sigma points through the camera's lens (3DGUT)");
    visitor.choice("lens", lens, lens_rule_names(),
                   "camera: as its file says, which takes the unscented projection if it distorts; "
                   "pinhole: distortion is left out");
    visitor.real("sigma_alpha", sigma.alpha, 1e-3, 10,
                 "spread of the sigma points; 1: sqrt(3) standard deviations (3DGUT)");
    visitor.real("sigma_beta", sigma.beta, 0, 100,
                 "what is known of the distribution; 2: that it is a Gaussian (3DGUT)");
    visitor.real("sigma_kappa", sigma.kappa, -2, 100, "second spread of the points; 0: 3DGUT");
    visitor.require(sigma.is_sound(),
                    {"sigma_beta",
                     "must be at least alpha^2 - 2 + 3 / (alpha^2 (3 + kappa)), so that no weight "
                     "of the covariance is negative",
                     "",
                     {"sigma_alpha", "sigma_kappa"}});
    if (projection == ProjectionRule::Linear) {
        for (const char* key : {"sigma_alpha", "sigma_beta", "sigma_kappa"}) {
            visitor.unused(key, "projection", "projection is linear");
        }
    }
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
    options.rule = projection;
    options.lens = lens;
    options.sigma = sigma;
    options.compensated =
        antialiasing == Antialiasing::On || (antialiasing == Antialiasing::Scene && antialiased);
    options.numbers = numbers;
    return options;
}

} // namespace degs
