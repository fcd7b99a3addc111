// SPDX-License-Identifier: Apache-2.0
// The double-precision images that runs are compared with.
#pragma once

#include <vector>

#include "scene/scene.hpp"
#include "splat/frame/frame_workload.hpp"
#include "splat/images/image.hpp"
#include "splat/reference/reference_renderer.hpp"

namespace degs::sim {

/// The double-precision image of a frame, with which any number of runs can be compared.
struct Reference {
    Image image;
    ReferenceCounts counts;
    double render_s = 0; ///< host, what one processor needs
};

/// The images that one frame is compared with.
struct References {
    std::vector<Reference> views; ///< one for each view
    std::vector<Reference> full;  ///< of foveated images: without foveation
};

Reference make_reference(const FrameWorkload& workload);
/// The reference of a frame in any format: what was not projected in double is projected again, and
/// the host seconds of that are added to `seconds`.
Reference make_reference(const GaussianCloud& cloud, const FrameWorkload& frame, double& seconds);
} // namespace degs::sim
