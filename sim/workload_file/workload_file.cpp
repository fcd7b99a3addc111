// SPDX-License-Identifier: Apache-2.0
#include "sim/workload_file/workload_file.hpp"

#include <algorithm>
#include <utility>

#include "base/parallel.hpp"
#include "scene/files/input_file.hpp"
#include "sim/text/words.hpp"
#include "sim/workload_file/file_layout.hpp"
#include "sim/workload_file/splat_block.hpp"

namespace degs::sim {
namespace {

std::string bytes_of_file(const std::string& path) {
    constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 36U;
    InputFile file(path);
    file.require_at_most(kMostBytes);
    // The beginning tells a file of another kind before all of it is read.
    std::string bytes(std::min<std::uint64_t>(file.size(), kWorkloadMagic.size()), '\0');
    file.read_exactly(bytes.data(), bytes.size());
    if (bytes == kWorkloadMagic) {
        const std::size_t begin = bytes.size();
        bytes.resize(file.size());
        file.read_exactly(bytes.data() + begin, bytes.size() - begin);
    }
    return bytes;
}

std::string byte_words(std::uint64_t bytes) {
    return grouped(bytes) + (bytes == 1 ? " byte" : " bytes");
}

/// Checks everything before the head, and the checksum.
void check_outside(const std::string& path, const std::string& bytes) {
    if (bytes.compare(0, kWorkloadMagic.size(), kWorkloadMagic) != 0) {
        fail_file(path, "its first 8 bytes are " +
                            in_quotes(bytes.substr(0, kWorkloadMagic.size())) +
                            ", but a workload begins with 'degswork'.");
    }
    constexpr std::size_t kLeast = kHeadAt + kChecksumBytes;
    if (bytes.size() < kLeast) {
        fail_file(path, "it has " + byte_words(bytes.size()) +
                            " and is truncated; a workload has " + std::to_string(kLeast) +
                            " at least.");
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
    const std::size_t end = bytes.size() - kChecksumBytes;
    const std::string right = checksum_bytes(std::string_view(bytes).substr(0, end));
    if (bytes.compare(end, kChecksumBytes, right) != 0) {
        fail_file(path, "the checksum in its last 16 bytes is " + in_digits(bytes.substr(end)) +
                            ", but what is before them has " + in_digits(right) +
                            "; the file is truncated or damaged.");
    }
}

} // namespace

std::string workload_checksum(const std::string& bytes) {
    return in_digits(std::string_view(bytes).substr(bytes.size() - kChecksumBytes));
}

WorkloadFile::WorkloadFile(const std::string& path) : WorkloadFile(path, bytes_of_file(path)) {}

WorkloadFile::WorkloadFile(const std::string& path, std::string bytes)
    : path_(path), bytes_(std::move(bytes)) {
    check_outside(path_, bytes_);
    take_head();
    head_.scene.source = path_;
    head_.scene.workload_xxh128 = workload_checksum(bytes_);
}

void WorkloadFile::take_head() {
    const std::uint64_t end = bytes_.size() - kChecksumBytes;
    const std::uint64_t head_bytes = little_endian_at(bytes_, kHeadBytesAt);
    if (head_bytes > kMostHeadBytes || head_bytes > end - kHeadAt) {
        fail_file(path_,
                  "the length of its head at byte 12 is " + std::to_string(head_bytes) +
                      ", but at most " +
                      std::to_string(std::min<std::uint64_t>(kMostHeadBytes, end - kHeadAt)) +
                      " are allowed here.");
    }
    head_ = read_head(path_, bytes_.substr(kHeadAt, head_bytes));
    std::uint64_t at = kHeadAt + head_bytes;
    for (const PackedProjection& projection : head_.projections) {
        begins_.push_back(at);
        std::uint64_t total = 0;
        for (const std::uint64_t block : projection.blocks) {
            total += block;
        }
        // Checked before memory is asked for.
        if (total > end - at || projection.splats * kBytesPerSplat / kMostInflation > total) {
            fail_file(path_, "'projections[" + std::to_string(begins_.size() - 1) +
                                 "]' of its head has " + grouped(projection.splats) +
                                 " splats in " + byte_words(total) + ", but " +
                                 byte_words(end - at) + " follow, and a byte may become " +
                                 std::to_string(kMostInflation) + " at most.");
        }
        at += total;
    }
    if (at != end) {
        fail_file(path_, byte_words(end - at) +
                             " follow behind its last splats, where only the checksum may.");
    }
}

ReadySplats WorkloadFile::splats(std::uint64_t number) const {
    const PackedProjection& projection = head_.projections[number];
    ReadySplats ready;
    ready.options = projection.options;
    ready.gaussians = head_.scene.gaussians;
    ready.sh_degree = head_.scene.sh_degree;
    ready.splats.resize(projection.splats);
    ready.means.resize(projection.splats);
    std::vector<std::uint64_t> begins;
    std::uint64_t at = begins_[number];
    for (const std::uint64_t block : projection.blocks) {
        begins.push_back(at);
        at += block;
    }
    const std::string place = "projection " + std::to_string(number);
    parallel_blocks(projection.blocks.size(), [&](std::size_t block, std::size_t) {
        const std::size_t first = block * kSplatsPerBlock;
        unpack_splats(path_, place + ", block " + std::to_string(block),
                      std::string_view(bytes_).substr(begins[block], projection.blocks[block]),
                      first, std::min(first + kSplatsPerBlock, ready.splats.size()), ready);
    });
    for (std::size_t first = kSplatsPerBlock; first < ready.splats.size();
         first += kSplatsPerBlock) {
        if (ready.splats[first].id <= ready.splats[first - 1].id) {
            fail_file(path_, place + ", splat " + std::to_string(first) + " is of Gaussian " +
                                 std::to_string(ready.splats[first].id) +
                                 ", but numbers must rise from block to block.");
        }
    }
    return ready;
}

FrameWorkload WorkloadFile::frame(const std::string& wanted_by, const ProjectionOptions& options,
                                  int tile_size, TileMode mode) const {
    std::string there;
    for (const PackedFrame& packed : head_.frames) {
        const ProjectionOptions& own = head_.projections[packed.projection].options;
        if (same_projection(own, options) && packed.tile_size == tile_size &&
            packed.tile_mode == mode) {
            const ReadySplats ready = splats(packed.projection);
            FrameWorkload frame =
                make_frame_workload(ready, head_.camera, tile_size, mode, packed.culled);
            if (frame.splats.size() != packed.visible) {
                fail_file(path_, "its frame of " + frame_words(own, tile_size, mode) + " lists " +
                                     grouped(frame.splats.size()) + " splats; the " +
                                     grouped(packed.visible) + " of its head are allowed.");
            }
            return frame;
        }
        if (!packed.designs.empty()) {
            there +=
                (there.empty() ? "" : "; ") + frame_words(own, packed.tile_size, packed.tile_mode);
        }
    }
    fail_file(path_, wanted_by + " needs a frame of " + frame_words(options, tile_size, mode) +
                         ", which the workload does not hold; it holds frames of " +
                         (there.empty() ? "no kind" : there) + ".");
}

} // namespace degs::sim
