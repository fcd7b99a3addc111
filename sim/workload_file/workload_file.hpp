// SPDX-License-Identifier: Apache-2.0
// Frames of a view in one file, from which designs run without the scene; docs/workload.md has its
// form.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scene/files/input_file.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/workload_file/workload_head.hpp"

namespace degs::sim {

/// Bytes that are not set to zero before they are read.
struct Part {
    std::unique_ptr<char[]> bytes;
    std::size_t size = 0;
    std::string_view view() const { return {bytes.get(), size}; }
};

/// A file whose head has been read and is undamaged. The splats and the lists of a frame are read,
/// each with a checksum in the head, when the frame is asked for.
class WorkloadFile {
public:
    /// Throws InputError, which names the file, the place, the reason and what is allowed.
    explicit WorkloadFile(const std::string& path);
    /// Takes the content of the file `path`, likewise.
    WorkloadFile(const std::string& path, std::string bytes);

    /// The source is the path of the file.
    const SceneFacts& facts() const { return head_.scene; }
    const Camera& camera() const { return head_.camera; }

    bool holds(const ProjectionOptions& options, int tile_size, TileMode mode) const;
    /// Throws InputError, which names the frames that are there, if this one is not, and for
    /// splats or lists that are damaged or that no frame has. `wanted_by` is the subject of the
    /// sentence.
    FrameWorkload frame(const std::string& wanted_by, const ProjectionOptions& options,
                        int tile_size, TileMode mode) const;

private:
    void take_head();
    const PackedFrame* find(const ProjectionOptions& options, int tile_size, TileMode mode) const;
    Part read(std::uint64_t at, std::uint64_t bytes) const;
    Part read_checked(const std::string& place, std::uint64_t at, std::uint64_t bytes,
                      const std::string& xxh128) const;
    void read_splats(std::uint64_t number, FrameWorkload& frame) const;
    void read_lists(std::size_t number, FrameWorkload& frame) const;

    InputWatch watch_;
    std::string path_, bytes_; ///< bytes: the content, unless it is read from the file
    std::uint64_t size_ = 0;
    WorkloadHead head_;
    std::vector<std::uint64_t> splats_at_, lists_at_; ///< bytes from the start
};

/// A frame to be packed, and the names of the designs that it was made for.
struct FrameToPack {
    FrameWorkload frame;
    std::vector<std::string> designs;
};

/// The bytes of a workload file; all frames are of the same scene and camera.
std::string pack_workload(const SceneFacts& scene, const std::vector<FrameToPack>& frames);

/// The checksum of a workload file, as a report shows it: the last 16 bytes, which are the XXH3 of
/// 128 bits of everything up to the end of the head. The head has the checksums of all else.
std::string workload_checksum(std::string_view bytes);

} // namespace degs::sim
