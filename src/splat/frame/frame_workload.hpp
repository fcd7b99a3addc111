// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "splat/frame/projection.hpp"
#include "splat/frame/tile_cover.hpp"
#include "splat/frame/tile_grid.hpp"

namespace degs {

struct CullCounts {
    std::uint64_t near = 0, transparent = 0, degenerate = 0, off_screen = 0;
    std::uint64_t near_in_view =
        0; ///< of `near`: in front of the camera, with the mean in the image
    CullCounts& operator+=(const CullCounts& other);
    std::uint64_t total() const { return near + transparent + degenerate + off_screen; }
    /// One sentence: how many were culled, and why.
    std::string explain() const;
};

/// Everything about one frame that does not depend on the accelerator: splats in depth order and
/// the list of every tile. Computed once and shared by all architectures (paper, Sec. V-A).
struct FrameWorkload {
    Camera camera;
    ProjectionOptions projection; ///< options of the projection
    int tile_size = 0;            ///< px
    TileMode tile_mode = TileMode::Exact;
    int tiles_x = 0, tiles_y = 0;
    std::uint64_t gaussians = 0; ///< in the scene, before culling
    int sh_degree = 0;
    CullCounts culled;
    std::vector<ProjectedSplat> splats;     ///< visible splats, near to far; equal depths by index
    std::vector<std::uint32_t> visible_of;  ///< indices of visible Gaussians in cloud order
    std::vector<glm::vec3> visible_means;   ///< means of visible Gaussians, scene units
    std::vector<std::uint64_t> tile_begin;  ///< tiles + 1 offsets into tile_splats
    std::vector<std::uint32_t> tile_splats; ///< indices into splats, ascending (= near to far)
    std::vector<std::uint32_t>
        tiles_touched; ///< per splat (same index as splats): tiles that list it

    int tiles() const { return tiles_x * tiles_y; }
    TileGrid grid() const { return TileGrid(camera, tile_size); }
    std::uint64_t tile_pairs() const { return tile_splats.size(); }
    /// Visible Gaussians among the first `first_gaussians` of the scene.
    std::uint32_t visible_among(std::uint64_t first_gaussians) const;
};

/// Projects, shades, sorts and bins a scene, in the format of `options`, on all processors;
/// culling, lists and order follow from its splats; one that no tile lists is not visible, and
/// counts as off_screen. The depth key is that of the options, rounded
/// to float, as the original sorts float bits; ties keep index order. Throws InputError for an
/// image without pixels, focal lengths or a tile size below 1, or a negative near plane.
FrameWorkload make_frame_workload(const GaussianCloud& cloud, const Camera& camera, int tile_size,
                                  TileMode mode, const ProjectionOptions& options = {});

} // namespace degs
