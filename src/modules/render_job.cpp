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

void RenderJob::add(const FrameWorkload& frame, const MemoryBases& base) {
    const auto f = static_cast<std::uint32_t>(frames.size());
    frames.push_back(&frame);
    bases.push_back(base);
    first_splat.push_back(path->add_frame(frame));
    pair_prefix.push_back(prefix_of_pairs(frame));
    images.emplace_back(frame.camera.width, frame.camera.height);
    const std::size_t before = tiles.size();
    for (int t = 0; t < frame.tiles(); ++t) {
        const std::uint64_t begin = frame.tile_begin[t];
        const std::uint64_t end = frame.tile_begin[t + 1];
        if (begin == end) {
            continue;
        }
        JobTile tile;
        tile.frame = f;
        tile.x = (t % frame.tiles_x) * tile_size;
        tile.y = (t / frame.tiles_x) * tile_size;
        tile.width = std::min(tile_size, frame.camera.width - tile.x);
        tile.height = std::min(tile_size, frame.camera.height - tile.y);
        tile.first = begin;
        tile.count = end - begin;
        tiles.push_back(tile);
    }
    tiles_of_frame.push_back(tiles.size() - before);
    if (tiles.size() != before) {
        tiles.back().last_of_frame = true;
    }
}

RenderJob make_render_job(const std::vector<const FrameWorkload*>& frames,
                          const DataPathOptions& options, int contexts) {
    RenderJob job;
    job.tile_size = frames.at(0)->tile_size;
    job.path = make_data_path(options, job.tile_size, contexts);
    for (const FrameWorkload* frame : frames) {
        job.add(*frame);
    }
    return job;
}

} // namespace degs
