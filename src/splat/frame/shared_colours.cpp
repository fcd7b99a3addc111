// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/shared_colours.hpp"

namespace degs {

void shade_from(const GaussianCloud& cloud, const glm::dvec3& position, FrameWorkload& frame) {
    Camera camera = frame.camera;
    camera.position = position;
    const std::unique_ptr<Projector> projector = make_projector(cloud, camera, frame.projection);
    for (ProjectedSplat& splat : frame.splats) {
        projector->shade(splat.id, splat); // black where it is not finite
    }
}

} // namespace degs
