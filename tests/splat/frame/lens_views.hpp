// SPDX-License-Identifier: Apache-2.0
// Views through lenses, for tests of the unscented projection.
#pragma once

#include "splat/frame/projection.hpp"
#include "tests/splat/frame/brute_force.hpp"
#include "tests/splat/model/published_lens.hpp"

namespace degs::test {

inline const PublishedLens kPinhole{"pinhole", false, {}};

inline ProjectionOptions unscented(const std::string& format = "fp64") {
    ProjectionOptions options;
    options.rule = ProjectionRule::Unscented;
    options.numbers.format = parse_format(format);
    return options;
}

inline std::vector<PublishedLens> all_lenses() {
    std::vector<PublishedLens> lenses = published_lenses();
    lenses.push_back(kPinhole);
    return lenses;
}

/// 70 degrees from corner to corner, turned and away from the origin.
inline Camera turned_camera(const PublishedLens& lens) {
    Camera camera = make_camera(1280, 720, 1000);
    camera.fy = 950;
    camera.lens = lens.lens();
    camera.position = {0.3, -0.2, -0.5};
    camera.camera_to_world =
        glm::dmat3(test::rotation_matrix(glm::normalize(glm::vec4(1, 0.1F, -0.2F, 0.3F))));
    return camera;
}

inline glm::dvec3 in_world(const Camera& camera, const glm::dvec3& seen) {
    return camera.camera_to_world * seen + camera.position;
}

} // namespace degs::test
