// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "splat/frame/frame_workload.hpp"
#include "splat/frame/projection.hpp"
#include "splat/model/camera.hpp"
#include "splat/model/gaussian.hpp"

namespace degs {

/// Values below which 10, 50, 90 and 99 % of a set lie.
struct Quantiles {
    double p10 = 0, p50 = 0, p90 = 0, p99 = 0;
};

/// By nearest rank; reorders `values`. All quantiles are 0 if `values` is empty.
Quantiles quantiles_of(std::vector<double>& values);

/// Statistics of a scene that do not depend on a view.
struct SceneStatistics {
    std::uint64_t gaussians = 0;
    int sh_degree = 0;
    SanitizeReport dropped;
    Quantiles anisotropy;   ///< largest over smallest standard deviation
    Quantiles flatness;     ///< middle over smallest: large for discs
    Quantiles elongation;   ///< largest over middle: large for needles
    Quantiles largest_axis; ///< standard deviation, scene units
    double largest_axis_max = 0;
    Quantiles opacity;
    double faint_share = 0;              ///< opacity < 1/255: never drawn
    double opaque_share = 0;             ///< opacity > 0.9
    double opacity_size_correlation = 0; ///< of log largest axis and opacity
    double sh_rest_rms = 0;              ///< root mean square of the coefficients above degree 0
    glm::dvec3 low{0.0};                 ///< 1st percentile of the means per axis, scene units
    glm::dvec3 high{0.0};                ///< 99th percentile
};

/// `dropped`, the Gaussians that sanitize() has removed before, is passed through.
SceneStatistics measure_scene(const GaussianCloud& cloud, const SanitizeReport& dropped = {});

/// Statistics of a view of a scene; the counts of the reference renderer.
struct ViewStatistics {
    CullCounts culled;
    std::uint64_t visible = 0;       ///< splats that some tile of 16 x 16 lists
    std::uint64_t tile_pairs = 0;    ///< tile list entries, tiles of 16 x 16
    std::uint64_t fragments = 0;     ///< pixel updates
    std::uint64_t candidates = 0;    ///< pixels inside the ellipses, whatever covers them
    double fragments_per_pixel = 0;  ///< depth complexity as drawn
    double candidates_per_pixel = 0; ///< depth complexity without early termination
    double terminated_share = 0;     ///< pixels that stopped early
    double covered_share = 0;        ///< pixels with transmittance below one half
    Quantiles footprint;             ///< diameter of the circle of the ellipse's area, px
    double footprint_gini = 0;       ///< Gini coefficient of the ellipses' areas
};

/// Renders the view once with the reference renderer.
ViewStatistics measure_view(const GaussianCloud& cloud, const Camera& camera,
                            const ProjectionOptions& options = {});

} // namespace degs
