// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "splat/projection.hpp"

namespace degs {

class ConfigVisitor;

/// Whether opacities make up for the low-pass filter: as the scene file says, never, or always.
enum class Antialiasing { Scene, Off, On };

/// What renderers of the same Gaussians disagree about. The defaults are those of the original 3DGS
/// rasteriser.
struct RenderingRules {
    SplatOrder order = SplatOrder::Depth;
    Antialiasing antialiasing = Antialiasing::Scene;
    double low_pass = ProjectionOptions().dilation; ///< px^2, see ProjectionOptions::dilation

    void describe(ConfigVisitor& visitor);
    /// The options that project a scene in a format; `antialiased` is what the file of the scene says
    /// (SceneTraits::antialiased).
    ProjectionOptions options(bool antialiased, const NumberFormat& format = {}) const;
};

/// "depth", "distance", in the order of SplatOrder.
const std::vector<const char*>& splat_order_names();
const char* name_of(SplatOrder order);
/// "scene", "off", "on", in the order of Antialiasing.
const std::vector<const char*>& antialiasing_names();

} // namespace degs
