// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/gini.hpp"
#include "base/ratio.hpp"
#include "splat/model/angles.hpp"
#include "splat/reference/reference_renderer.hpp"

namespace degs {
namespace {

using Values = std::vector<double>;

double nearest_rank(Values& values, double share) {
    const auto rank = std::llround(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[rank];
}

template <class Function>
Values collect(std::size_t count, Function function) {
    Values values(count);
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = function(i);
    }
    return values;
}

template <class Predicate>
double share_of(const std::vector<float>& values, Predicate predicate) {
    const auto count = std::count_if(values.begin(), values.end(), predicate);
    return ratio_of(count, values.size());
}

/// Ascending; a flat Gaussian (scale 0) counts as the smallest normal float, so that ratios are
/// finite.
std::array<double, 3> sorted_axes(const glm::vec3& scale) {
    constexpr float kSmallest = 1.17549435e-38F;
    std::array<double, 3> axes{std::max(scale.x, kSmallest), std::max(scale.y, kSmallest),
                               std::max(scale.z, kSmallest)};
    std::sort(axes.begin(), axes.end());
    return axes;
}

double correlation(const Values& a, const Values& b) {
    const double mean_a = mean_of(std::accumulate(a.begin(), a.end(), 0.0), a.size());
    const double mean_b = mean_of(std::accumulate(b.begin(), b.end(), 0.0), b.size());
    double ab = 0;
    double aa = 0;
    double bb = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ab += (a[i] - mean_a) * (b[i] - mean_b);
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
    }
    return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

void measure_shapes(const GaussianCloud& cloud, SceneStatistics& out) {
    const std::size_t n = cloud.size();
    const auto axes = [&](std::size_t i) { return sorted_axes(cloud.scales[i]); };
    Values anisotropy = collect(n, [&](std::size_t i) { return axes(i)[2] / axes(i)[0]; });
    Values flatness = collect(n, [&](std::size_t i) { return axes(i)[1] / axes(i)[0]; });
    Values elongation = collect(n, [&](std::size_t i) { return axes(i)[2] / axes(i)[1]; });
    Values largest = collect(n, [&](std::size_t i) { return axes(i)[2]; });
    out.opacity_size_correlation =
        correlation(collect(n, [&](std::size_t i) { return std::log(largest[i]); }),
                    collect(n, [&](std::size_t i) { return cloud.opacities[i]; }));
    out.anisotropy = quantiles_of(anisotropy);
    out.flatness = quantiles_of(flatness);
    out.elongation = quantiles_of(elongation);
    out.largest_axis = quantiles_of(largest);
    out.largest_axis_max = n == 0 ? 0 : *std::max_element(largest.begin(), largest.end());
}

void measure_opacity(const GaussianCloud& cloud, SceneStatistics& out) {
    Values opacity(cloud.opacities.begin(), cloud.opacities.end());
    out.opacity = quantiles_of(opacity);
    out.faint_share = share_of(cloud.opacities, [](float o) { return o < 1.0F / 255; });
    out.opaque_share = share_of(cloud.opacities, [](float o) { return o > 0.9F; });
}

void measure_extent(const GaussianCloud& cloud, SceneStatistics& out) {
    for (int axis = 0; axis < 3 && !cloud.empty(); ++axis) {
        Values values = collect(cloud.size(), [&](std::size_t i) { return cloud.means[i][axis]; });
        out.low[axis] = nearest_rank(values, 0.01);
        out.high[axis] = nearest_rank(values, 0.99);
    }
}

double rest_rms(const GaussianCloud& cloud) {
    const std::size_t values = cloud.sh_coefficients() * 3;
    double sum = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        for (std::size_t k = 3; k < values; ++k) {
            const double coefficient = cloud.sh_of(i)[k];
            sum += coefficient * coefficient;
        }
    }
    return std::sqrt(mean_of(sum, cloud.size() * (values - 3)));
}

/// Pixels inside q <= Q_th, by area: pi Q_th sqrt(det).
double ellipse_area(const ProjectedSplat& splat) {
    return kPi * splat.q_threshold * std::sqrt(splat.det);
}

/// Pixel centres of the image inside the ellipse, row by row.
std::uint64_t pixels_inside(const ProjectedSplat& splat, const Camera& camera) {
    const PixelBox box = pixel_box(splat, camera.window());
    std::uint64_t pixels = 0;
    for (int y = box.y0; y <= box.y1; ++y) {
        const double dy = y - splat.mu_y;
        const double reach = splat.q_end() - dy * dy / splat.cov_c;
        if (reach >= 0) {
            const double centre = splat.mu_x + splat.cov_b / splat.cov_c * dy;
            const double half = std::sqrt(splat.det / splat.cov_c * reach);
            const double first = std::max<double>(box.x0, std::ceil(centre - half));
            const double last = std::min<double>(box.x1, std::floor(centre + half));
            pixels += static_cast<std::uint64_t>(std::max(0.0, last - first + 1));
        }
    }
    return pixels;
}

} // namespace

Quantiles quantiles_of(std::vector<double>& values) {
    if (values.empty()) {
        return {};
    }
    return {nearest_rank(values, 0.1), nearest_rank(values, 0.5), nearest_rank(values, 0.9),
            nearest_rank(values, 0.99)};
}

SceneStatistics measure_scene(const GaussianCloud& cloud, const SanitizeReport& dropped) {
    SceneStatistics out;
    out.gaussians = cloud.size();
    out.sh_degree = cloud.sh_degree;
    out.dropped = dropped;
    measure_shapes(cloud, out);
    measure_opacity(cloud, out);
    measure_extent(cloud, out);
    out.sh_rest_rms = rest_rms(cloud);
    return out;
}

ViewStatistics measure_view(const GaussianCloud& cloud, const Camera& camera,
                            const ProjectionOptions& options) {
    constexpr int kTile = 16;
    const FrameWorkload work = make_frame_workload(cloud, camera, kTile, TileMode::Exact, options);
    ReferenceCounts counts;
    const Image image = render_reference(work, counts);
    const std::size_t pixels = image.pixels();
    ViewStatistics out;
    out.culled = work.culled;
    out.visible = work.splats.size();
    out.tile_pairs = work.tile_pairs();
    out.fragments = counts.fragments;
    Values footprint;
    Values areas;
    footprint.reserve(work.splats.size());
    areas.reserve(work.splats.size());
    for (const ProjectedSplat& splat : work.splats) {
        out.candidates += pixels_inside(splat, camera);
        areas.push_back(ellipse_area(splat));
        footprint.push_back(2 * std::sqrt(areas.back() / 3.14159265358979323846));
    }
    out.footprint = quantiles_of(footprint);
    out.footprint_gini = gini(std::move(areas));
    out.fragments_per_pixel = ratio_of(out.fragments, pixels);
    out.candidates_per_pixel = ratio_of(out.candidates, pixels);
    out.terminated_share = ratio_of(counts.terminated, pixels);
    out.covered_share = share_of(image.transmittance, [](float t) { return t < 0.5F; });
    return out;
}

} // namespace degs
