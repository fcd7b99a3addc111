// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "modules/messages.hpp"
#include "splat/frame_workload.hpp"
#include "splat/image.hpp"

namespace degs {

/// A tile that lists at least one splat. Empty tiles never enter the pipeline.
struct JobTile {
    std::uint32_t frame = 0;
    int x = 0, y = 0;          ///< top left pixel in the image
    int width = 0, height = 0; ///< pixels inside the image
    std::uint64_t first = 0;   ///< into the frame's tile_splats
    std::uint64_t count = 0;
    bool last_of_frame = false;
};

/// What an accelerator is asked to render, and the arithmetic it renders with.
struct RenderJob {
    std::vector<const FrameWorkload*> frames;
    std::vector<std::uint32_t> first_splat; ///< DataPath index of each frame's splat 0
    std::vector<JobTile> tiles;             ///< raster order within each frame
    std::vector<Image> images;              ///< one per frame, filled by the Pixel Buffer
    std::unique_ptr<DataPath> path;
    int tile_size = 0;
    /// Per frame: tile pairs of the first n visible Gaussians in scene order, for n = 0..visible.
    std::vector<std::vector<std::uint64_t>> pair_prefix;

    std::uint64_t pairs_before(std::uint32_t frame, std::uint32_t visible_rank) const {
        return pair_prefix[frame][visible_rank];
    }
    const FrameWorkload& frame_of(const JobTile& tile) const { return *frames[tile.frame]; }
};

/// Lists the tiles and loads the data path. All workloads must have the same tile size.
RenderJob make_render_job(const std::vector<const FrameWorkload*>& frames,
                          const DataPathOptions& options, int contexts);

} // namespace degs
