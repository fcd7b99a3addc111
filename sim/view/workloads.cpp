// SPDX-License-Identifier: Apache-2.0
#include "sim/view/workloads.hpp"

#include <utility>

#include "degs/error.hpp"
#include "scene/cameras/eyes.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/text/progress.hpp"
#include "splat/frame/shared_colours.hpp"

namespace degs::sim {

std::vector<FrameWorkload> make_workloads(const GaussianCloud& cloud, const SceneTraits& traits,
                                          const std::vector<Camera>& cameras,
                                          const AcceleratorConfig& config, double& seconds) {
    const Progress progress("projecting and sorting");
    const Stopwatch clock;
    std::vector<FrameWorkload> workloads;
    workloads.reserve(cameras.size());
    const ProjectionOptions options = projection_of(config.data_path(), traits.antialiased);
    for (const Camera& camera : cameras) {
        workloads.push_back(
            make_frame_workload(cloud, camera, config.tile_size_px(), config.tile_mode(), options));
    }
    seconds += clock.seconds();
    return workloads;
}

void require_frames(const DynamicScene& scene, int frames) {
    if (frames > scene.frames()) {
        throw InputError("The scene has " + std::to_string(scene.frames()) + " frames, and " +
                         std::to_string(frames) + " were asked for (--frames).");
    }
}

std::vector<FrameWorkload> make_workloads(const DynamicScene& scene, const SceneTraits& traits,
                                          const std::vector<Camera>& cameras,
                                          const AcceleratorConfig& config, double& seconds,
                                          int views) {
    const int frames = static_cast<int>(cameras.size()) / views;
    require_frames(scene, frames);
    std::vector<FrameWorkload> workloads;
    for (int k = 0; k < frames; ++k) {
        const GaussianCloud cloud = scene.frame(k);
        const auto first = cameras.begin() + k * views;
        for (FrameWorkload& view :
             make_workloads(cloud, traits, {first, first + views}, config, seconds)) {
            workloads.push_back(std::move(view));
        }
    }
    return workloads;
}

void share_colours(const GaussianCloud& cloud, std::vector<FrameWorkload>& frames,
                   std::size_t first, std::size_t count) {
    std::vector<Camera> cameras;
    for (std::size_t f = first; f < first + count; ++f) {
        cameras.push_back(frames[f].camera);
    }
    for (std::size_t f = first; f < first + count; ++f) {
        shade_from(cloud, middle_of(cameras), frames[f]);
    }
}

} // namespace degs::sim
