// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "degs/error.hpp"
#include "sim/workload_file/file_layout.hpp"
#include "sim/workload_file/splat_block.hpp"
#include "sim/workload_file/workload_file.hpp"

namespace degs::sim {
namespace {

/// Adds the splats of a frame that are not there yet, in the order of the cloud.
void add_splats(const FrameWorkload& frame, ReadySplats& all) {
    std::vector<ProjectedSplat> splats = frame.splats;
    const auto before = [](const ProjectedSplat& a, const ProjectedSplat& b) {
        return a.id < b.id;
    };
    std::sort(splats.begin(), splats.end(), before);
    ReadySplats joined;
    joined.options = frame.projection;
    joined.gaussians = frame.gaussians;
    joined.sh_degree = frame.sh_degree;
    std::size_t own = 0, old = 0;
    while (own < splats.size() || old < all.splats.size()) {
        const bool from_old = own == splats.size() ||
                              (old < all.splats.size() && !before(splats[own], all.splats[old]));
        if (!from_old) {
            joined.splats.push_back(splats[own]);
            joined.means.push_back(frame.visible_means[own]);
            ++own;
            continue;
        }
        own += own < splats.size() && splats[own].id == all.splats[old].id ? 1 : 0;
        joined.splats.push_back(all.splats[old]);
        joined.means.push_back(all.means[old]);
        ++old;
    }
    all = std::move(joined);
}

/// The splats of every projection; tells for every frame which of them it needs.
std::vector<ReadySplats> projections_of(const std::vector<FrameToPack>& frames,
                                        std::vector<PackedFrame>& packed) {
    std::vector<ReadySplats> projections;
    for (const FrameToPack& each : frames) {
        const FrameWorkload& frame = each.frame;
        const auto found =
            std::find_if(projections.begin(), projections.end(), [&](const ReadySplats& other) {
                return same_projection(other.options, frame.projection);
            });
        PackedFrame entry;
        entry.projection = static_cast<std::uint64_t>(found - projections.begin());
        entry.tile_size = frame.tile_size;
        entry.tile_mode = frame.tile_mode;
        entry.visible = frame.splats.size();
        entry.culled = frame.culled;
        entry.designs = each.designs;
        packed.push_back(entry);
        if (found == projections.end()) {
            projections.emplace_back();
        }
        add_splats(frame, projections[entry.projection]);
    }
    return projections;
}

} // namespace

std::string pack_workload(const SceneFacts& scene, const std::vector<FrameToPack>& frames) {
    WorkloadHead head;
    head.scene = scene;
    head.camera = frames.front().frame.camera;
    std::string blocks;
    for (const ReadySplats& splats : projections_of(frames, head.frames)) {
        PackedProjection projection;
        projection.options = splats.options;
        projection.splats = splats.splats.size();
        for (std::size_t first = 0; first < splats.splats.size(); first += kSplatsPerBlock) {
            const std::string block =
                pack_splats(splats, first, std::min(first + kSplatsPerBlock, splats.splats.size()));
            projection.blocks.push_back(block.size());
            blocks += block;
        }
        head.projections.push_back(std::move(projection));
    }
    const std::string text = head_text(head);
    if (text.size() > kMostHeadBytes) {
        throw InputError("The head of the workload would have " + std::to_string(text.size()) +
                         " bytes; at most " + std::to_string(kMostHeadBytes) +
                         " are allowed, so that fewer designs fit into one file.");
    }
    std::string bytes(kWorkloadMagic);
    bytes += little_endian(kWorkloadVersion) +
             little_endian(static_cast<std::uint32_t>(text.size())) + text + blocks;
    return bytes + checksum_bytes(bytes);
}

} // namespace degs::sim
