// SPDX-License-Identifier: Apache-2.0
#include "sim/shell/rule_options.hpp"

namespace degs::sim {

CLI::Option* add_near_option(CLI::App& command, double& near) {
    return command
        .add_option("--near", near,
                    "near plane, scene units; Gaussians at or before it are not drawn")
        ->check(CLI::Range(0.0, kFarthestNearPlane))
        ->capture_default_str();
}

void add_projection_options(CLI::App& command, RenderingRules& rules) {
    command
        .add_option_function<std::string>(
            "--projection",
            [&rules](const std::string& name) {
                rules.projection = name == name_of(ProjectionRule::Unscented)
                                       ? ProjectionRule::Unscented
                                       : ProjectionRule::Linear;
            },
            "linear: by the Jacobian of a pinhole; unscented: by seven points through the lens")
        ->check(CLI::IsMember(projection_rule_names()))
        ->default_str(name_of(rules.projection));
    command
        .add_option_function<std::string>(
            "--lens",
            [&rules](const std::string& name) {
                rules.lens =
                    name == name_of(LensRule::Pinhole) ? LensRule::Pinhole : LensRule::Camera;
            },
            "camera: as its file says; pinhole: lens distortion is left out")
        ->check(CLI::IsMember(lens_rule_names()))
        ->default_str(name_of(rules.lens));
}

void add_rule_options(CLI::App& command, RenderingRules& rules) {
    command // before the other rules, which change single ones
        .add_option_function<std::string>(
            "--rules",
            [&rules](const std::string& name) {
                rules = RenderingRules(name == "khr" ? RuleSet::Khr : RuleSet::Inria);
            },
            "where the rules below start: the reference code, or KHR_gaussian_splatting, i.e. "
            "order distance and cut 9")
        ->check(CLI::IsMember(rule_set_names()))
        ->default_str("inria");
    command
        .add_option_function<std::string>(
            "--order",
            [&rules](const std::string& name) {
                rules.order = name == name_of(SplatOrder::Distance) ? SplatOrder::Distance
                                                                    : SplatOrder::Depth;
            },
            "depth: splats are blended by view z; distance: by that to the camera")
        ->check(CLI::IsMember(splat_order_names()))
        ->default_str(name_of(rules.order));
    command
        .add_option_function<std::string>(
            "--antialiasing",
            [&rules](const std::string& name) {
                rules.antialiasing = name == "on"    ? Antialiasing::On
                                     : name == "off" ? Antialiasing::Off
                                                     : Antialiasing::Scene;
            },
            "whether opacities make up for the low-pass filter; scene: as its file says")
        ->check(CLI::IsMember(antialiasing_names()))
        ->default_str("scene");
    add_projection_options(command, rules);
    command.add_option("--low-pass", rules.low_pass, "px^2 added to both variances of a splat")
        ->check(CLI::Range(0.0, 10.0))
        ->capture_default_str();
    command
        .add_option("--cut", rules.cut,
                    "squared Mahalanobis distance at which splats end; 12: where alpha is 1/255")
        ->check(CLI::Range(0.0, kNoCut))
        ->capture_default_str();
    add_near_option(command, rules.near);
}

} // namespace degs::sim
