// SPDX-License-Identifier: Apache-2.0
// What a workload file says of its frames before their splats; docs/workload.md has its form.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/simulation/simulation.hpp"

namespace degs::sim {

/// Splats of one projection, which frames with other tiles share.
struct PackedProjection {
    ProjectionOptions options;
    std::uint64_t splats = 0;
    std::vector<std::uint64_t> blocks; ///< bytes of each, see blocks_of()
};

/// A frame that can be made from the splats of a projection.
struct PackedFrame {
    std::uint64_t projection = 0; ///< its place in the list
    int tile_size = 0;            ///< px
    TileMode tile_mode = TileMode::Exact;
    std::uint64_t visible = 0; ///< splats that the tiles list
    CullCounts culled;
    std::vector<std::string> designs; ///< names of those that it was packed for
};

struct WorkloadHead {
    SceneFacts scene; ///< without a source
    Camera camera;
    std::vector<PackedProjection> projections;
    std::vector<PackedFrame> frames;
};

/// Whether two projections give the same splats.
bool same_projection(const ProjectionOptions& a, const ProjectionOptions& b);

/// A kind of frame in words: "32 px tiles (exact), fp32".
std::string frame_words(const ProjectionOptions& options, int tile_size, TileMode mode);

/// The head as a JSON text.
std::string head_text(const WorkloadHead& head);

/// Reads such a text of the file `path`. Throws InputError, which names the value and what is
/// allowed, unless every value is there and in its range.
WorkloadHead read_head(const std::string& path, const std::string& text);

} // namespace degs::sim
