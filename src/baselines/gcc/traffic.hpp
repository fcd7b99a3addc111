// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "modules/render_job.hpp"

namespace degs::gcc {

/// Record layouts of GCC's streams. A Gaussian is stored stage by stage, so that one that is
/// dropped early costs only the stages that have read it.
struct Traffic {
    int mean_bytes = 6;       ///< per Gaussian, Stage I: 3 values of 2 B
    int bound_bytes = 2;      ///< per Gaussian, Stage I: radius of a sphere around it
    int shape_bytes = 16;     ///< per Gaussian and view, Stage II: scale 3, rotation 4, opacity 1
    int sh_value_bytes = 2;   ///< per coefficient and channel, Stage III
    int list_entry_bytes = 8; ///< depth key 4, index 4
    int pixel_bytes = 4;      ///< per frame-buffer pixel, RGBA8
    int burst_bytes = 64;     ///< scattered records are read in whole bursts
    void describe(ConfigVisitor& visitor);

    /// The records that all accelerators have.
    TrafficConfig common() const;
    std::uint64_t stage_one_bytes() const { return mean_bytes + bound_bytes; }
    std::uint64_t entry_bytes() const { return list_entry_bytes; }
    /// Bytes on the bus for one scattered record of `record` bytes at index `index` of its array.
    std::uint64_t scattered(std::uint64_t record, std::uint64_t index) const {
        const std::uint64_t burst = burst_bytes;
        return (((index + 1) * record - 1) / burst - index * record / burst + 1) * burst;
    }
};

/// The addresses of GCC's streams. The stages of a Gaussian are in the geometry region, lists of
/// groups behind the lists of views.
struct MemoryMap {
    std::uint64_t means = 0, shapes = 0, sh = 0, groups = 0, views = 0;
    MemoryMap(const Traffic& traffic, const RenderJob& job, std::uint32_t frame);
};

} // namespace degs::gcc
