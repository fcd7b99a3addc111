// SPDX-License-Identifier: Apache-2.0
// What a workload file says of its frames before their splats; docs/workload.md has its form.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/view/frame_facts.hpp"

namespace degs::sim {

/// Splats of one projection, which frames with other tiles share if they show the same Gaussians.
struct PackedProjection {
    ProjectionOptions options;
    std::uint64_t splats = 0;
    std::vector<std::uint64_t> blocks; ///< bytes of each: of all Gaussians, then of all splats
    std::string xxh128;                ///< checksum of the blocks
};

/// Tile lists of the splats of a projection.
struct PackedFrame {
    std::uint64_t projection = 0; ///< its place in the list
    int tile_size = 0;            ///< px
    TileMode tile_mode = TileMode::Exact;
    std::uint64_t entries = 0; ///< of all lists
    CullCounts culled;
    std::vector<std::string> designs;  ///< names of those that it was packed for
    std::vector<std::uint64_t> blocks; ///< bytes of each: the lengths of the lists, then the lists
    std::string xxh128;                ///< checksum of the blocks
};

struct WorkloadHead {
    SceneFacts scene; ///< without a source
    Camera camera;
    std::vector<PackedProjection> projections;
    std::vector<PackedFrame> frames;
};

/// The bytes of all blocks together.
std::uint64_t length_of(const std::vector<std::uint64_t>& blocks);

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
