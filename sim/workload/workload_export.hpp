// SPDX-License-Identifier: Apache-2.0
// A frame as an array gets it, in files that other programs read; docs/workload.md has their form.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modules/kit/accelerator/render_engine.hpp"
#include "sim/shell/output_folder.hpp"

namespace degs::sim {

/// What has been written to a file.
struct ExportedFile {
    std::string name;
    std::uint64_t records = 0;
    std::string xxh128; ///< of its bytes, as `xxhsum -H2` prints it
};

struct ExportedWorkload {
    int tile_size = 0, tiles_x = 0, tiles_y = 0;
    std::uint64_t tiles = 0; ///< with a list
    std::uint64_t splats = 0, pixels = 0;
    ExportedFile lists, rows;
};

/// The document first.
std::vector<std::string> workload_files();

/// Writes lists.csv and rows.csv of a frame that was made for the design, line by line. The rows
/// are solved with the data path of the design.
ExportedWorkload export_workload(const FrameWorkload& frame, const AcceleratorConfig& design,
                                 const OutputFolder& out);

} // namespace degs::sim
