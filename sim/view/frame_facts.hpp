// SPDX-License-Identifier: Apache-2.0
// What is known of a scene and of a frame of it when their Gaussians and splats are not there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "splat/frame/frame_workload.hpp"
#include "splat/reference/reference_renderer.hpp"

namespace degs::sim {

/// The facts of a scene that stay when its Gaussians have become a workload.
struct SceneFacts {
    std::string name, source;
    std::uint64_t gaussians = 0;
    int sh_degree = 0;
    SanitizeReport dropped;         ///< Gaussians of the file that cannot be drawn
    SceneTraits traits;             ///< how the file wants to be drawn
    std::vector<std::string> notes; ///< sentences: what was guessed or passed over in the file
    std::string workload_xxh128;    ///< checksum of the workload file that the source is, if any
};

struct WorkloadFacts {
    std::uint64_t gaussians = 0, visible = 0, tile_pairs = 0;
    CullCounts culled;
    ProjectionOptions projection; ///< of the accelerator's splats
    int tile_size = 0;
    std::uint64_t tiles = 0, empty_tiles = 0, pixels = 0; ///< without hidden tiles
    std::optional<ReferenceCounts> reference;
};

SceneFacts facts_of(const Scene& scene);
WorkloadFacts facts_of(const FrameWorkload& workload);

} // namespace degs::sim
