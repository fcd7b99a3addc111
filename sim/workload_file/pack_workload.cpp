// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "degs/error.hpp"
#include "sim/workload_file/file_layout.hpp"
#include "sim/workload_file/list_block.hpp"
#include "sim/workload_file/splat_block.hpp"
#include "sim/workload_file/workload_file.hpp"

namespace degs::sim {
namespace {

/// Adds blocks to a part of the file; the head has their lengths.
void add(const std::string& block, std::vector<std::uint64_t>& lengths, std::string& part) {
    lengths.push_back(block.size());
    part += block;
}

/// Appends the splats of a frame to the bytes.
PackedProjection pack_projection(const FrameWorkload& frame, std::string& bytes) {
    PackedProjection packed;
    packed.options = frame.projection;
    packed.splats = frame.splats.size();
    std::string part;
    for (auto* const pack : {&pack_gaussians, &pack_splats}) {
        for (std::size_t first = 0; first < frame.splats.size(); first += kSplatsPerBlock) {
            const std::size_t end = std::min(first + kSplatsPerBlock, frame.splats.size());
            add(pack(frame, first, end), packed.blocks, part);
        }
    }
    packed.xxh128 = in_digits(checksum_bytes(part));
    bytes += part;
    return packed;
}

/// Appends the lists of a frame to the bytes.
PackedFrame pack_frame(const FrameToPack& each, std::size_t projection, std::string& bytes) {
    const FrameWorkload& frame = each.frame;
    PackedFrame packed;
    packed.projection = projection;
    packed.tile_size = frame.tile_size;
    packed.tile_mode = frame.tile_mode;
    packed.entries = frame.tile_splats.size();
    packed.culled = frame.culled;
    packed.designs = each.designs;
    std::string part;
    add(pack_lengths(frame), packed.blocks, part);
    const std::vector<std::size_t> cuts = list_cuts(frame.tile_begin);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        add(pack_lists(frame, cuts[k], cuts[k + 1]), packed.blocks, part);
    }
    packed.xxh128 = in_digits(checksum_bytes(part));
    bytes += part;
    return packed;
}

} // namespace

std::string pack_workload(const SceneFacts& scene, const std::vector<FrameToPack>& frames) {
    WorkloadHead head;
    head.scene = scene;
    head.camera = frames.front().frame.camera;
    std::vector<const FrameWorkload*> owners; // of the projections
    std::string splats, lists;
    for (const FrameToPack& each : frames) {
        const auto found =
            std::find_if(owners.begin(), owners.end(), [&](const FrameWorkload* other) {
                return same_projection(other->projection, each.frame.projection) &&
                       other->visible_of == each.frame.visible_of;
            });
        const auto place = static_cast<std::size_t>(found - owners.begin());
        if (found == owners.end()) {
            owners.push_back(&each.frame);
            head.projections.push_back(pack_projection(each.frame, splats));
        }
        head.frames.push_back(pack_frame(each, place, lists));
    }
    const std::string text = head_text(head);
    if (text.size() > kMostHeadBytes) {
        throw InputError("The head of the workload would have " + std::to_string(text.size()) +
                         " bytes; at most " + std::to_string(kMostHeadBytes) +
                         " are allowed, so that fewer designs fit into one file.");
    }
    std::string bytes(kWorkloadMagic);
    bytes += little_endian(kWorkloadVersion) +
             little_endian(static_cast<std::uint32_t>(text.size())) + text;
    const std::string checksum = checksum_bytes(bytes);
    return bytes + splats + lists + checksum;
}

} // namespace degs::sim
