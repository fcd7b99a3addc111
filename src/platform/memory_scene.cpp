// SPDX-License-Identifier: Apache-2.0
#include "degs/scene.hpp"

#include <algorithm>

#include "platform/scene_copy.hpp"
#include "scene/scene.hpp"

namespace degs {
namespace {

MemoryScene::View view_of(const Camera& camera) {
    MemoryScene::View view;
    view.name = camera.name;
    view.width = camera.width;
    view.height = camera.height;
    view.focal_x = camera.fx;
    view.focal_y = camera.fy;
    view.shift_x = camera.shift.x;
    view.shift_y = camera.shift.y;
    view.origin_x = camera.origin.x;
    view.origin_y = camera.origin.y;
    for (int i = 0; i < 9; ++i) {
        view.axes[i] = camera.camera_to_world[i / 3][i % 3];
        view.position[i % 3] = camera.position[i % 3];
    }
    const LensCoefficients& lens = camera.lens.coefficients();
    view.lens = static_cast<LensKind>(lens.kind);
    std::copy(lens.radial.begin(), lens.radial.end(), view.radial);
    std::copy(lens.denominator.begin(), lens.denominator.end(), view.denominator);
    std::copy(lens.tangential.begin(), lens.tangential.end(), view.tangential);
    return view;
}

} // namespace

MemoryScene load_memory_scene(const std::string& scene, const std::string& cameras_file) {
    const Scene loaded = load_scene(scene, cameras_file);
    MemoryScene made;
    encode_scene(loaded.cloud, made.geometry, made.sh);
    made.gaussians = static_cast<std::uint32_t>(loaded.cloud.size());
    made.sh_degree = static_cast<std::uint32_t>(loaded.cloud.sh_degree);
    made.antialiased = loaded.traits.antialiased;
    for (const Camera& camera : loaded.cameras) {
        made.views.push_back(view_of(camera));
    }
    made.notes = loaded.notes;
    return made;
}

} // namespace degs
