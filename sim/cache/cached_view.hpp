// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/input_files.hpp"
#include "sim/cache/frame_cache.hpp"
#include "sim/simulation/foveated_image.hpp"
#include "sim/simulation/view.hpp"
#include "sim/workload_file/workload_file.hpp"

namespace degs::sim {

/// What precedes the simulation of a view, found in the cache or made. The Gaussians of the scene
/// are loaded when something has to be made from them. A view of a workload file has none: its
/// frames come from the file, and nothing is kept.
class CachedView {
public:
    /// Throws InputError for mistakes in the view, its scene and its cameras.
    CachedView(const ViewRequest& request, const PathRequest& path, FrameCache cache);

    /// Facts of the scene as it was loaded, also when its Gaussians are not there.
    const SceneFacts& facts() const { return facts_; }
    /// Cameras of the path, the view's own first, or of the views of each of its frames. A scene
    /// that changes is seen by a camera that stands still.
    const std::vector<Camera>& cameras() const { return cameras_; }
    /// Views of a frame follow each other among the cameras and the frames.
    int views() const { return views_; }
    /// The images of the first frame if they are foveated; the views of a frame are their levels,
    /// image by image.
    const std::optional<FoveatedViews>& foveated() const { return foveated_; }
    /// The frames with colours that the views of each share: those from their middle.
    std::vector<FrameWorkload> with_shared_colours(const std::vector<FrameWorkload>& frames);
    /// The frames with the tiles of the accelerator, projected in its numbers.
    std::vector<FrameWorkload> frames(const AcceleratorConfig& config);
    /// Throws InputError if the view is a workload file without the reference of such a frame.
    void require_reference(const FrameWorkload& frame) const;
    /// The reference of such a frame.
    Reference reference(const FrameWorkload& frame);
    /// The reference of a foveated image without foveation, drawn by the rules of `frame`. Kept at
    /// once if it took some time.
    Reference full_reference(const Camera& camera, const FrameWorkload& frame);
    /// Something had to be made from the Gaussians, which are still there.
    bool has_cloud() const { return !scene_.cloud.empty(); }
    /// Frees the Gaussians; they are loaded again if they are needed after all.
    void forget_cloud();
    /// Keeps what was made and took some time: the frames, and references, as they were returned,
    /// of the first ones.
    void keep(const std::vector<FrameWorkload>& frames, const std::vector<Reference>& references);

    double load_s() const { return load_s_; }         ///< host
    double workload_s() const { return workload_s_; } ///< host, projections

private:
    void open_workload(const PathRequest& path);
    /// Puts the levels of each camera in its place. Throws InputError if their numbers differ.
    void foveate(const Foveation& foveation);
    /// A frame of the workload file.
    FrameWorkload packed_frame(const std::string& wanted_by, const ProjectionOptions& options,
                               int tile_size, TileMode mode);
    /// Loads the scene if it is not there.
    const GaussianCloud& cloud();
    /// The key in the cache of the scene as frame `k` shows it.
    std::string frame_key(std::size_t k) const;

    InputWatch watch_; ///< from the key of the scene on
    ViewRequest request_;
    FrameCache cache_;
    std::string key_;                       ///< of the scene
    Scene scene_;                           ///< may be without its cloud
    std::unique_ptr<DynamicScene> dynamic_; ///< if the scene changes and several frames are wanted
    std::optional<WorkloadFile> workload_;  ///< instead of a scene
    SceneFacts facts_;
    std::vector<Camera> cameras_;
    std::optional<FoveatedViews> foveated_;
    int views_ = 1;
    double load_s_ = 0, workload_s_ = 0;
    bool frames_made_ = false, reference_made_ = false; ///< and worth keeping
};

} // namespace degs::sim
