// SPDX-License-Identifier: Apache-2.0
// From cameras to the frames of a design.
#pragma once

#include <vector>

#include "modules/kit/accelerator/render_engine.hpp"
#include "scene/dynamic_scene.hpp"
#include "scene/scene.hpp"
#include "splat/frame/frame_workload.hpp"

namespace degs::sim {

/// The frames of `cameras` with the tiles of the accelerator, projected in its numbers and by its
/// rules; adds the host seconds to `seconds`.
std::vector<FrameWorkload> make_workloads(const GaussianCloud& cloud, const SceneTraits& traits,
                                          const std::vector<Camera>& cameras,
                                          const AcceleratorConfig& config, double& seconds);
/// InputError for more frames than the scene has.
void require_frames(const DynamicScene& scene, int frames);
/// The frames of a scene that changes, made like those of a cloud: frame k, seen by the `views`
/// cameras from k x views on. InputError for more frames than the scene has.
std::vector<FrameWorkload> make_workloads(const DynamicScene& scene, const SceneTraits& traits,
                                          const std::vector<Camera>& cameras,
                                          const AcceleratorConfig& config, double& seconds,
                                          int views = 1);
/// Gives `count` frames of a cloud, from `first` on, the colours that they have from the middle of
/// their cameras.
void share_colours(const GaussianCloud& cloud, std::vector<FrameWorkload>& frames,
                   std::size_t first, std::size_t count);

} // namespace degs::sim
