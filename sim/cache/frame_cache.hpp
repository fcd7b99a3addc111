// SPDX-License-Identifier: Apache-2.0
// What precedes a simulation, kept for the next run on the same view.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/cache/disk_cache.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/reference.hpp"

namespace degs::sim {

/// A scene without its Gaussians.
struct SceneCard {
    SceneFacts facts;
    std::vector<Camera> cameras;
};

/// Scenes, projected frames and reference images, each found by everything that it depends on:
/// contents of files, the camera, the options of the projection, and the program itself.
class FrameCache {
public:
    /// In the folder that DEGS_CACHE names, else in degs of XDG_CACHE_HOME, else in ~/.cache/degs;
    /// at most DEGS_CACHE_BYTES, by default 4 GiB. An empty DEGS_CACHE, or no such folder: no
    /// cache. A folder that others own or may write is not used, with a warning. Throws InputError
    /// if DEGS_CACHE_BYTES is not a number.
    static FrameCache of_user();
    /// A cache that keeps nothing.
    FrameCache() = default;
    explicit FrameCache(DiskCache disk);

    bool on() const { return disk_.has_value(); }

    /// Names the content of a scene and of the cameras that it would be loaded with, for this
    /// executable; empty if off.
    std::string scene_key(const std::string& spec, const std::string& camera_file) const;
    /// The name and source of the facts are those of the run that kept them.
    std::optional<SceneCard> scene(const std::string& scene_key) const;
    void keep(const std::string& scene_key, const SceneCard& card) const;

    std::optional<FrameWorkload> frame(const std::string& scene_key, const Camera& camera,
                                       int tile_size, TileMode mode,
                                       const ProjectionOptions& options) const;
    void keep(const std::string& scene_key, const FrameWorkload& frame) const;

    /// The reference of a frame, whatever the format that the frame itself was projected in.
    std::optional<Reference> reference(const std::string& scene_key,
                                       const FrameWorkload& frame) const;
    void keep(const std::string& scene_key, const FrameWorkload& frame,
              const Reference& reference) const;

private:
    std::optional<DiskCache> disk_;
};

} // namespace degs::sim
