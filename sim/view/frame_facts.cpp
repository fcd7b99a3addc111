// SPDX-License-Identifier: Apache-2.0
#include "sim/view/frame_facts.hpp"

namespace degs::sim {

SceneFacts facts_of(const Scene& scene) {
    return {scene.name,    scene.source, scene.cloud.size(), scene.cloud.sh_degree,
            scene.dropped, scene.traits, scene.notes,        ""};
}

WorkloadFacts facts_of(const FrameWorkload& workload) {
    WorkloadFacts facts;
    facts.gaussians = workload.gaussians;
    facts.visible = workload.splats.size();
    facts.tile_pairs = workload.tile_pairs();
    facts.culled = workload.culled;
    facts.projection = workload.projection;
    facts.tile_size = workload.tile_size;
    const TileGrid grid = workload.grid();
    facts.tiles = grid.shown_tiles();
    facts.pixels = grid.shown_pixels();
    for (int t = 0; t < workload.tiles(); ++t) {
        const bool lists = workload.tile_begin[t] != workload.tile_begin[t + 1];
        facts.empty_tiles += lists || grid.is_hidden(t) ? 0 : 1;
    }
    return facts;
}

} // namespace degs::sim
