// SPDX-License-Identifier: Apache-2.0
#include "sim/view/view_group.hpp"

#include "scene/cameras/eyes.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {
namespace {

std::vector<Camera> heads_of(const PathRequest& path, const PathSource& source) {
    const Camera first = source.camera_at(source.camera);
    if (path.frames == 1 || source.stands_still) {
        return std::vector<Camera>(path.frames, first);
    }
    return camera_path(source.cloud(), first, path.frames, path.step_degrees, path.near_plane);
}

} // namespace

std::vector<Camera> cameras_of_frames(const PathRequest& path, const PathSource& source) {
    const GroupRequest& group = path.group;
    std::vector<Camera> all;
    if (!group.cameras.empty()) {
        for (int k = 0; k < path.frames; ++k) {
            for (const int position : group.cameras) {
                all.push_back(source.camera_at(position));
            }
        }
        return all;
    }
    std::vector<Camera> heads = heads_of(path, source);
    if (!group.eyes_m) {
        return heads;
    }
    for (const Camera& head : heads) {
        for (Camera& eye : eyes_of(head, *group.eyes_m * group.units_per_metre)) {
            all.push_back(std::move(eye));
        }
    }
    return all;
}

std::vector<Camera> cameras_of_frame(const ViewRequest& request, const GroupRequest& group,
                                     const Scene& scene) {
    PathRequest path;
    path.group = group;
    PathSource source;
    source.camera = request.camera;
    source.camera_at = [&request, &scene](int position) {
        ViewRequest view = request;
        view.camera = position;
        return camera_of(view, scene);
    };
    return cameras_of_frames(path, source);
}

} // namespace degs::sim
