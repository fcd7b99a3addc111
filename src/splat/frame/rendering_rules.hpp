// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "splat/frame/projection.hpp"

namespace degs {

class ConfigVisitor;

/// The largest near plane that may be asked for, scene units.
constexpr double kFarthestNearPlane = 1e9;

/// Whether opacities make up for the low-pass filter: as the scene file says, never, or always.
enum class Antialiasing { Scene, Off, On };

/// Sets of rules: those of the original 3DGS rasteriser, and what KHR_gaussian_splatting asks for.
enum class RuleSet { Inria, Khr };

/// What renderers of the same Gaussians disagree about. The defaults are those of the original 3DGS
/// rasteriser.
struct RenderingRules {
    RuleSet preset = RuleSet::Inria; ///< the set that the others started from
    SplatOrder order = SplatOrder::Depth;
    ProjectionRule projection = ProjectionRule::Linear;
    LensRule lens = LensRule::Camera;
    SigmaPoints sigma; ///< of the unscented projection
    Antialiasing antialiasing = Antialiasing::Scene;
    double low_pass = ProjectionOptions().dilation; ///< px^2, see ProjectionOptions::dilation
    double cut = ProjectionOptions().cut;           ///< of q, see ProjectionOptions::cut
    double near =
        ProjectionOptions().near_plane; ///< scene units, see ProjectionOptions::near_plane

    RenderingRules() = default;
    /// The rules of a set.
    explicit RenderingRules(RuleSet set);

    /// A preset other than the present one replaces the rules before they are visited.
    void describe(ConfigVisitor& visitor);
    /// The options that project a scene in such formats; `antialiased` is what the file of the
    /// scene says (SceneTraits::antialiased).
    ProjectionOptions options(bool antialiased, const ProjectionNumbers& numbers = {}) const;
};

/// "inria", "khr", in the order of RuleSet.
const std::vector<const char*>& rule_set_names();
/// "depth", "distance", in the order of SplatOrder.
const std::vector<const char*>& splat_order_names();
const char* name_of(SplatOrder order);
/// "linear", "unscented", in the order of ProjectionRule.
const std::vector<const char*>& projection_rule_names();
const char* name_of(ProjectionRule rule);
/// "camera", "pinhole", in the order of LensRule.
const std::vector<const char*>& lens_rule_names();
const char* name_of(LensRule rule);
/// "scene", "off", "on", in the order of Antialiasing.
const std::vector<const char*>& antialiasing_names();

} // namespace degs
