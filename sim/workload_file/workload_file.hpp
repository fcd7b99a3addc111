// SPDX-License-Identifier: Apache-2.0
// Frames of a view in one file, from which designs run without the scene; docs/workload.md has its
// form.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/simulation/simulation.hpp"
#include "sim/workload_file/workload_head.hpp"

namespace degs::sim {

/// A file that has been read and whose checksum is right. Splats are unpacked when a frame asks for
/// them.
class WorkloadFile {
public:
    /// Throws InputError, which names the file, the place, the reason and what is allowed.
    explicit WorkloadFile(const std::string& path);
    /// Takes the content of the file `path`, likewise.
    WorkloadFile(const std::string& path, std::string bytes);

    /// The source is the path of the file.
    const SceneFacts& facts() const { return head_.scene; }
    const Camera& camera() const { return head_.camera; }
    const WorkloadHead& head() const { return head_; }
    std::uint64_t bytes() const { return bytes_.size(); }

    /// Throws InputError, which names the frames that are there, if this one is not, and for
    /// splats that do not fit it. `wanted_by` is the subject of the sentence.
    FrameWorkload frame(const std::string& wanted_by, const ProjectionOptions& options,
                        int tile_size, TileMode mode) const;

private:
    void take_head();
    ReadySplats splats(std::uint64_t projection) const;

    std::string path_, bytes_;
    WorkloadHead head_;
    std::vector<std::uint64_t> begins_; ///< of the projections' blocks, bytes from the start
};

/// A frame to be packed, and the names of the designs that it was made for.
struct FrameToPack {
    FrameWorkload frame;
    std::vector<std::string> designs;
};

/// The bytes of a workload file; all frames are of the same scene and camera.
std::string pack_workload(const SceneFacts& scene, const std::vector<FrameToPack>& frames);

/// The checksum of a workload file, as a report shows it: the XXH3 of 128 bits of all bytes but the
/// last 16, which hold it.
std::string workload_checksum(const std::string& bytes);

} // namespace degs::sim
