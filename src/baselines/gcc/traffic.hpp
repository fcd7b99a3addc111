// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "modules/kit/job/render_job.hpp"

namespace degs::gcc {

/// Record layouts of GCC's streams. A Gaussian is stored stage by stage, so that one that is
/// dropped early costs only the stages that have read it.
struct Traffic {
    int mean_bytes = 0;       ///< per Gaussian, Stage I; 0: as formats need
    int bound_bytes = 2;      ///< per Gaussian, Stage I: radius of a sphere around it
    int shape_bytes = 0;      ///< per Gaussian and view, Stage II: scale 3, rotation 4, opacity 1
    int sh_value_bytes = 0;   ///< per coefficient and channel, Stage III
    int list_entry_bytes = 8; ///< depth key 4, index 4
    int pixel_bytes = 4;      ///< per frame-buffer pixel, RGBA8
    int burst_bytes = 64;     ///< scattered records are read in whole bursts
    /// Not 0: all stages of a Gaussian lie in one record of this many bytes, in the order of the
    /// stages, as in a platform's memory; the mean comes first and the shape last.
    int gaussian_bytes = 0;
    void describe(ConfigVisitor& visitor);

    TrafficConfig formats; ///< whose sizes follow from those of the pipeline
    /// The records that all accelerators have.
    TrafficConfig common() const;
    std::uint64_t stage_one_bytes() const { return common().mean_size() + bound_bytes; }
    int shape_size() const { return common().shape_size(); }
    std::uint64_t entry_bytes() const { return list_entry_bytes; }
};

/// The addresses of GCC's streams. The stages of a Gaussian are in the geometry region, lists of
/// groups behind the lists of views.
struct MemoryMap {
    std::uint64_t means = 0, shapes = 0, sh = 0, groups = 0, views = 0;
    MemoryMap(const Traffic& traffic, const RenderJob& job, std::uint32_t frame);
};

/// The shapes of `count` Gaussians.
ScatteredRecords shape_records(const Traffic& traffic, const RenderJob& job, std::uint32_t frame,
                               const std::uint32_t* gaussians, std::size_t count);

} // namespace degs::gcc
