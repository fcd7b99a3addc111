// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "splat/foveation/foveation.hpp"

namespace degs::sim {

/// A camera and the views that draw its image.
struct FoveatedView {
    Camera camera;
    std::vector<FoveatedLevel> levels; ///< finest first
};

/// The images of a frame.
struct FoveatedViews {
    Foveation asked;
    std::vector<FoveatedView> images; ///< with as many levels each
};

} // namespace degs::sim
