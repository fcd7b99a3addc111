// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/eyes.hpp"

namespace degs {

std::vector<Camera> eyes_of(const Camera& middle, double distance) {
    Camera left = middle;
    Camera right = middle;
    const glm::dvec3 half = middle.camera_to_world[0] * (distance / 2);
    left.position -= half;
    right.position += half;
    return {left, right};
}

glm::dvec3 middle_of(const std::vector<Camera>& cameras) {
    glm::dvec3 sum(0.0);
    double count = 0;
    for (const Camera& camera : cameras) {
        sum += camera.position;
        ++count;
    }
    return sum / count;
}

} // namespace degs
