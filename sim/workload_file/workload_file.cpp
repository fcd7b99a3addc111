// SPDX-License-Identifier: Apache-2.0
#include "sim/workload_file/workload_file.hpp"

#include <algorithm>
#include <utility>

#include "base/parallel.hpp"
#include "scene/files/input_file.hpp"
#include "sim/text/words.hpp"
#include "sim/workload_file/file_layout.hpp"
#include "sim/workload_file/list_block.hpp"
#include "sim/workload_file/splat_block.hpp"
#include "splat/frame/tile_cover.hpp"

namespace degs::sim {
namespace {

std::string byte_words(std::uint64_t bytes) {
    return grouped(bytes) + (bytes == 1 ? " byte" : " bytes");
}

/// Checks what is before the head.
void check_beginning(const std::string& path, std::string_view bytes) {
    if (bytes.substr(0, kWorkloadMagic.size()) != kWorkloadMagic) {
        fail_file(path, "its first 8 bytes are " +
                            in_quotes(bytes.substr(0, kWorkloadMagic.size())) +
                            ", but a workload begins with 'degswork'.");
    }
    if (bytes.size() < kHeadAt) {
        fail_file(path, "it has " + byte_words(bytes.size()) +
                            " and is truncated; a workload has " +
                            std::to_string(kHeadAt + kChecksumBytes) + " at least.");
    }
    const std::uint32_t version = little_endian_at(bytes, kVersionAt);
    if (version != kWorkloadVersion) {
        const bool swapped = version == kWorkloadVersion << 24U;
        fail_file(path, swapped ? "the version at byte 8 has its highest byte first; only numbers "
                                  "with their lowest byte first are allowed."
                                : "the version at byte 8 is " + std::to_string(version) +
                                      "; this program reads version " +
                                      std::to_string(kWorkloadVersion) + ".");
    }
}

/// Where each block begins, from the start of the first one.
std::vector<std::uint64_t> begins_of(const std::vector<std::uint64_t>& blocks) {
    std::vector<std::uint64_t> begins{0};
    for (const std::uint64_t block : blocks) {
        begins.push_back(begins.back() + block);
    }
    return begins;
}

} // namespace

std::string workload_checksum(std::string_view bytes) {
    return in_digits(bytes.substr(bytes.size() - kChecksumBytes));
}

WorkloadFile::WorkloadFile(const std::string& path) : WorkloadFile(path, "") {}

WorkloadFile::WorkloadFile(const std::string& path, std::string bytes)
    : path_(path), bytes_(std::move(bytes)) {
    constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 36U;
    if (bytes_.empty()) {
        const InputFile file(path_);
        file.require_at_most(kMostBytes);
        size_ = file.size();
    } else {
        size_ = bytes_.size();
    }
    take_head();
    head_.scene.source = path_;
}

Part WorkloadFile::read(std::uint64_t at, std::uint64_t bytes) const {
    Part part{std::unique_ptr<char[]>(new char[bytes]), bytes};
    if (bytes_.empty()) {
        InputFile file(path_);
        file.seek(at);
        file.read_exactly(part.bytes.get(), bytes);
        watch_.require_unchanged();
    } else {
        std::copy_n(bytes_.data() + at, bytes, part.bytes.get());
    }
    return part;
}

Part WorkloadFile::read_checked(const std::string& place, std::uint64_t at, std::uint64_t bytes,
                                const std::string& xxh128) const {
    Part part = read(at, bytes);
    const std::string found = in_digits(checksum_bytes(part.view()));
    if (found != xxh128) {
        fail_file(path_, place + " has the checksum " + found + ", but that of its head is " +
                             in_quotes(xxh128) + "; the file is damaged.");
    }
    return part;
}

void WorkloadFile::take_head() {
    const Part beginning = read(0, std::min<std::uint64_t>(size_, kHeadAt));
    check_beginning(path_, beginning.view());
    const std::uint64_t head_bytes = little_endian_at(beginning.view(), kHeadBytesAt);
    const std::uint64_t most =
        std::min<std::uint64_t>(kMostHeadBytes, size_ - std::min(size_, kHeadAt + kChecksumBytes));
    if (head_bytes > most) {
        fail_file(path_, "the length of its head at byte 12 is " + std::to_string(head_bytes) +
                             ", but at most " + std::to_string(most) +
                             " are allowed here; the file may be truncated.");
    }
    const Part head = read(0, kHeadAt + head_bytes);
    const std::uint64_t end = size_ - kChecksumBytes;
    const Part checksum = read(end, kChecksumBytes);
    const std::string right = checksum_bytes(head.view());
    if (checksum.view() != right) {
        fail_file(path_, "the checksum in its last 16 bytes is " + in_digits(checksum.view()) +
                             ", but its head has " + in_digits(right) +
                             "; the file is truncated or damaged.");
    }
    head_ = read_head(path_, std::string(head.view().substr(kHeadAt)));
    head_.scene.workload_xxh128 = workload_checksum(checksum.view());
    std::uint64_t at = kHeadAt + head_bytes;
    const auto take = [&](const std::vector<std::uint64_t>& blocks,
                          std::vector<std::uint64_t>& begins) {
        begins.push_back(at);
        at += length_of(blocks);
        if (at > end) {
            fail_file(path_, "the blocks of its head end at byte " + grouped(at) +
                                 ", but its checksum begins at byte " + grouped(end) +
                                 "; the file is truncated or damaged.");
        }
    };
    for (const PackedProjection& projection : head_.projections) {
        take(projection.blocks, splats_at_);
    }
    for (const PackedFrame& frame : head_.frames) {
        take(frame.blocks, lists_at_);
    }
    if (at != end) {
        fail_file(path_, byte_words(end - at) +
                             " follow behind its last lists, where only the checksum may.");
    }
}

void WorkloadFile::read_splats(std::uint64_t number, FrameWorkload& frame) const {
    const PackedProjection& projection = head_.projections[number];
    const std::string place = "projection " + std::to_string(number);
    const Part part =
        read_checked(place, splats_at_[number], length_of(projection.blocks), projection.xxh128);
    const std::vector<std::uint64_t> begins = begins_of(projection.blocks);
    frame.visible_of.resize(projection.splats);
    frame.visible_means.resize(projection.splats);
    frame.splats.resize(projection.splats);
    const SplatUnpacker unpacker(path_, frame);
    std::vector<PlaneReader::Workspace> workspaces(host_threads());
    const std::size_t half = blocks_of(projection.splats);
    for (const bool gaussians : {true, false}) { // splats find theirs by its place
        parallel_blocks(half, [&](std::size_t block, std::size_t worker) {
            const std::size_t k = gaussians ? block : half + block;
            const std::size_t first = block * kSplatsPerBlock;
            const std::size_t end = std::min(first + kSplatsPerBlock, frame.splats.size());
            const std::string name = place + ", block " + std::to_string(k);
            const std::string_view bytes = part.view().substr(begins[k], projection.blocks[k]);
            gaussians ? unpacker.gaussians(name, bytes, first, end, workspaces[worker])
                      : unpacker.splats(name, bytes, first, end, workspaces[worker]);
        });
    }
    unpacker.check_whole(place);
}

void WorkloadFile::read_lists(std::size_t number, FrameWorkload& frame) const {
    const PackedFrame& packed = head_.frames[number];
    const std::string place = "frame " + std::to_string(number);
    const Part part =
        read_checked(place, lists_at_[number], length_of(packed.blocks), packed.xxh128);
    const std::vector<std::uint64_t> begins = begins_of(packed.blocks);
    const auto block = [&](std::size_t k) {
        return part.view().substr(begins[k], packed.blocks[k]);
    };
    frame.tile_begin.assign(frame.tiles() + std::size_t{1}, 0);
    unpack_lengths(path_, place + ", block 0", block(0), frame.splats.size(), packed.entries,
                   frame.tile_begin);
    const std::vector<std::size_t> cuts = list_cuts(frame.tile_begin);
    if (packed.blocks.size() != cuts.size()) {
        fail_file(path_, place + " has " + std::to_string(packed.blocks.size()) +
                             " blocks, but the lengths of its lists need " +
                             std::to_string(cuts.size()) + ".");
    }
    frame.tile_splats.resize(packed.entries);
    std::vector<PlaneReader::Workspace> workspaces(host_threads());
    std::vector<std::vector<std::uint32_t>> touched(
        host_threads(), std::vector<std::uint32_t>(frame.splats.size(), 0));
    parallel_blocks(cuts.size() - 1, [&](std::size_t k, std::size_t worker) {
        unpack_lists(path_, place + ", block " + std::to_string(1 + k), block(1 + k), cuts[k],
                     cuts[k + 1], workspaces[worker], frame, touched[worker]);
    });
    frame.tiles_touched = std::move(touched.front());
    for (std::size_t worker = 1; worker < touched.size(); ++worker) {
        for (std::size_t i = 0; i < frame.splats.size(); ++i) {
            frame.tiles_touched[i] += touched[worker][i];
        }
    }
    const auto none = std::find(frame.tiles_touched.begin(), frame.tiles_touched.end(), 0U);
    if (none != frame.tiles_touched.end()) {
        fail_file(path_, place + ", splat " + std::to_string(none - frame.tiles_touched.begin()) +
                             " is in no list; only splats that a tile lists are allowed.");
    }
}

const PackedFrame* WorkloadFile::find(const ProjectionOptions& options, int tile_size,
                                      TileMode mode) const {
    for (const PackedFrame& packed : head_.frames) {
        if (same_projection(head_.projections[packed.projection].options, options) &&
            packed.tile_size == tile_size && packed.tile_mode == mode) {
            return &packed;
        }
    }
    return nullptr;
}

bool WorkloadFile::holds(const ProjectionOptions& options, int tile_size, TileMode mode) const {
    return find(options, tile_size, mode) != nullptr;
}

FrameWorkload WorkloadFile::frame(const std::string& wanted_by, const ProjectionOptions& options,
                                  int tile_size, TileMode mode) const {
    const PackedFrame* const packed = find(options, tile_size, mode);
    if (packed == nullptr) {
        std::string there;
        for (const PackedFrame& other : head_.frames) {
            if (!other.designs.empty()) {
                there += (there.empty() ? "" : "; ") +
                         frame_words(head_.projections[other.projection].options, other.tile_size,
                                     other.tile_mode);
            }
        }
        fail_file(path_, wanted_by + " needs a frame of " + frame_words(options, tile_size, mode) +
                             ", which the workload does not hold; it holds frames of " +
                             (there.empty() ? "no kind" : there) + ".");
    }
    const TileGrid grid(head_.camera, tile_size);
    FrameWorkload frame;
    frame.camera = head_.camera;
    frame.projection = head_.projections[packed->projection].options;
    frame.tile_size = tile_size;
    frame.tile_mode = mode;
    frame.tiles_x = grid.tiles_x();
    frame.tiles_y = grid.tiles_y();
    frame.gaussians = head_.scene.gaussians;
    frame.sh_degree = head_.scene.sh_degree;
    frame.culled = packed->culled;
    read_splats(packed->projection, frame);
    read_lists(static_cast<std::size_t>(packed - head_.frames.data()), frame);
    return frame;
}

} // namespace degs::sim
