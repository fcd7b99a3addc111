// SPDX-License-Identifier: Apache-2.0
#include "modules/render_job.hpp"

#include <algorithm>

namespace degs {

namespace {

// Splats are in depth order, Gaussians are streamed in scene order.
std::vector<std::uint64_t> prefix_of_pairs(const FrameWorkload& frame) {
    std::vector<std::uint32_t> rank(frame.gaussians, 0);
    for (std::uint32_t v = 0; v < frame.visible_of.size(); ++v) {
        rank[frame.visible_of[v]] = v;
    }
    std::vector<std::uint64_t> prefix(frame.visible_of.size() + 1, 0);
    for (std::size_t s = 0; s < frame.splats.size(); ++s) {
        prefix[rank[frame.splats[s].id] + 1] = frame.tiles_touched[s];
    }
    for (std::size_t v = 1; v < prefix.size(); ++v) {
        prefix[v] += prefix[v - 1];
    }
    return prefix;
}

} // namespace

RenderJob make_render_job(const std::vector<const FrameWorkload*>& frames,
                          const DataPathOptions& options, int contexts) {
    RenderJob job;
    job.frames = frames;
    job.tile_size = frames.at(0)->tile_size;
    job.path = make_data_path(options, job.tile_size, contexts);
    for (std::uint32_t f = 0; f < frames.size(); ++f) {
        const FrameWorkload& frame = *frames[f];
        job.first_splat.push_back(job.path->add_frame(frame));
        job.pair_prefix.push_back(prefix_of_pairs(frame));
        job.images.emplace_back(frame.camera.width, frame.camera.height);
        for (int t = 0; t < frame.tiles(); ++t) {
            const std::uint64_t begin = frame.tile_begin[static_cast<std::size_t>(t)];
            const std::uint64_t end = frame.tile_begin[static_cast<std::size_t>(t) + 1];
            if (begin == end) {
                continue;
            }
            JobTile tile;
            tile.frame = f;
            tile.x = (t % frame.tiles_x) * job.tile_size;
            tile.y = (t / frame.tiles_x) * job.tile_size;
            tile.width = std::min(job.tile_size, frame.camera.width - tile.x);
            tile.height = std::min(job.tile_size, frame.camera.height - tile.y);
            tile.first = begin;
            tile.count = end - begin;
            job.tiles.push_back(tile);
        }
        if (!job.tiles.empty() && job.tiles.back().frame == f) {
            job.tiles.back().last_of_frame = true;
        }
    }
    return job;
}

} // namespace degs
