// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/input_files.hpp"
#include "sim/cache/frame_cache.hpp"
#include "sim/view/foveated_view.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/frame_kind.hpp"
#include "sim/view/reference.hpp"
#include "sim/view/view.hpp"
#include "sim/view/workloads.hpp"
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
    /// The views of the first frame with the tiles of the accelerator, projected in its numbers.
    std::vector<FramePointer> first_frame(const AcceleratorConfig& config);
    /// All frames of the path, of which the first is there. The others are found, or made and kept
    /// if that takes some time, when they are taken; the Gaussians are freed when the last one is.
    /// Views have the colours from the middle of their frame if the accelerator shares them. This,
    /// `config` and `first` outlive the source.
    FrameSource frames(const AcceleratorConfig& config, const std::vector<FramePointer>& first);
    /// Throws InputError if the view is a workload file without the reference of such a frame.
    void require_reference(const FrameWorkload& frame) const;
    /// Whether references of the first frame are made from Gaussians, which frames() frees.
    bool references_need_cloud(const FrameWorkload& frame) const;
    /// The references of the first frame, found or made.
    References references(const std::vector<FramePointer>& first);
    /// Frees the Gaussians; they are loaded again if they are needed after all.
    void forget_cloud();
    /// Keeps what was made and took some time: the first frame, and its references, as they were
    /// returned.
    void keep(const std::vector<FramePointer>& first, const std::vector<Reference>& references);

    /// Has the first frame for the accelerator in memory from now on, for this process and its
    /// forks, and frees the Gaussians.
    void hold_first_frame(const AcceleratorConfig& config);
    bool holds_first_frame(const AcceleratorConfig& config) const;
    /// Bytes of the frames that are held.
    std::uint64_t held_bytes() const;
    /// Between two uses of a view that is held, its files may change: whoever goes on has found
    /// that they have not.
    void pause() { watch_.reset(); }
    void go_on();

    double load_s() const { return load_s_; }         ///< host
    double workload_s() const { return workload_s_; } ///< host, projections

private:
    Reference reference(const FrameWorkload& frame);
    /// The reference of a foveated image without foveation, drawn by the rules of `frame`. Kept at
    /// once if it took some time.
    Reference full_reference(const Camera& camera, const FrameWorkload& frame);
    void open_workload(const PathRequest& path);
    /// Puts the levels of each camera in its place. Throws InputError if their numbers differ.
    void foveate(const Foveation& foveation);
    /// A frame of the workload file.
    FrameWorkload packed_frame(const std::string& wanted_by, const ProjectionOptions& options,
                               int tile_size, TileMode mode);
    /// Loads the scene if it is not there.
    const GaussianCloud& cloud();
    /// The key in the cache of the scene as view `k` of all shows it.
    std::string frame_key(std::size_t k) const;
    /// The views of a frame, if all of them are in the cache; else empty.
    std::vector<FramePointer> kept_frame(const AcceleratorConfig& config, std::size_t frame);
    std::vector<FramePointer> made_frame(const AcceleratorConfig& config, std::size_t frame);
    std::vector<FramePointer> later_frame(const AcceleratorConfig& config, std::size_t frame);
    void share_colours(std::vector<FramePointer>& views, std::size_t frame);

    std::optional<InputWatch> watch_{std::in_place}; ///< from the key of the scene on
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
    std::map<FrameKind, std::vector<FramePointer>> held_; ///< first frames
    double load_s_ = 0, workload_s_ = 0;
    double made_s_ = 0; ///< host, of frames that were not in the cache
    std::vector<std::pair<std::size_t, FramePointer>>
        unkept_; ///< made in less time than is worth it
    bool first_made_ = false;
    bool reference_made_ = false; ///< and worth keeping
};

} // namespace degs::sim
