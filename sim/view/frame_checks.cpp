// SPDX-License-Identifier: Apache-2.0
#include "sim/view/frame_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace degs::sim {
namespace {

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Every list is a range of the entries, and its splats are there, near to far.
bool has_sound_lists(const FrameWorkload& frame) {
    const std::vector<std::uint64_t>& begin = frame.tile_begin;
    const std::size_t tiles = std::size_t{1} * frame.tiles_x * frame.tiles_y;
    if (begin.size() != tiles + 1 || begin.front() != 0 ||
        begin.back() != frame.tile_splats.size() || !std::is_sorted(begin.begin(), begin.end())) {
        return false;
    }
    std::vector<std::uint32_t> touched(frame.splats.size(), 0);
    for (std::size_t tile = 0; tile < tiles; ++tile) {
        for (std::uint64_t i = begin[tile]; i < begin[tile + 1]; ++i) {
            const std::uint32_t splat = frame.tile_splats[i];
            if (splat >= touched.size() || (i > begin[tile] && splat <= frame.tile_splats[i - 1])) {
                return false;
            }
            ++touched[splat];
        }
    }
    return touched == frame.tiles_touched;
}

/// Visible Gaussians are some of the scene, and every splat is one of them.
bool has_sound_splats(const FrameWorkload& frame) {
    std::vector<std::uint32_t> ids;
    ids.reserve(frame.splats.size());
    const Rounder key_of(frame.projection.numbers.depth_key); // gives the order of the splats
    const SplatLimits limits(frame.projection);
    float depth = -std::numeric_limits<float>::infinity();
    for (const ProjectedSplat& splat : frame.splats) {
        const auto key = static_cast<float>(key_of(splat.depth));
        if (!is_sound(splat, limits) || key < depth) {
            return false;
        }
        depth = key;
        ids.push_back(splat.id);
    }
    std::sort(ids.begin(), ids.end());
    const bool distinct = std::adjacent_find(ids.begin(), ids.end()) == ids.end();
    return distinct && ids == frame.visible_of && (ids.empty() || ids.back() < frame.gaussians) &&
           frame.visible_means.size() == ids.size() &&
           std::all_of(frame.visible_means.begin(), frame.visible_means.end(),
                       [](const glm::vec3& mean) { return is_finite(glm::dvec3(mean)); });
}

/// The sum of what may be added without passing over the whole.
bool adds_up(const CullCounts& culled, std::uint64_t visible, std::uint64_t whole) {
    for (const std::uint64_t part :
         {visible, culled.near, culled.transparent, culled.degenerate, culled.off_screen}) {
        if (part > whole) {
            return false;
        }
        whole -= part;
    }
    return whole == 0 && culled.near_in_view <= culled.near;
}

} // namespace

bool is_sound(const Camera& camera) {
    constexpr double kRounding = 1e-3;
    const glm::dmat3 product = glm::transpose(camera.camera_to_world) * camera.camera_to_world;
    bool good = camera.width >= 1 && camera.width <= kMostCameraSide && camera.height >= 1 &&
                camera.height <= kMostCameraSide && camera.fx > 0 && std::isfinite(camera.fx) &&
                camera.fy > 0 && std::isfinite(camera.fy) && is_finite(camera.position) &&
                camera.has_sound_raster() && camera.lens.is_sound();
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            const double wanted = row == column ? 1 : 0;
            good = good && std::abs(product[column][row] - wanted) <= kRounding;
        }
    }
    return good;
}

SplatLimits::SplatLimits(const ProjectionOptions& options) {
    constexpr double kRounding = 1e-6;
    // Narrow formats round Q_th by up to a half of it, and the opacity then follows from Q_th and
    // from what a cut takes away of it.
    const bool exact = options.numbers.is_reference();
    most_q = (exact ? 1.0 : 1.5) * options.cut + kRounding;
    most_opacity = exact ? 1 + kRounding : options.alpha_min * std::exp(0.75 * kNoCut + kRounding);
}

bool is_sound(const ProjectedSplat& s, const SplatLimits& limits) {
    bool good = std::isfinite(s.mu_x) && std::isfinite(s.mu_y) && std::isfinite(s.depth) &&
                std::isfinite(s.cov_b) && s.cov_a >= 0 && std::isfinite(s.cov_a) && s.cov_c >= 0 &&
                std::isfinite(s.cov_c) && s.det > 0 && std::isfinite(s.det);
    good = good && s.opacity >= 0 && s.opacity <= limits.most_opacity && s.q_threshold >= 0 &&
           s.q_threshold <= limits.most_q && s.q_cut_off >= 0 && s.q_cut_off <= kNoCut;
    for (const double channel : s.colour) {
        good = good && channel >= 0 && std::isfinite(channel);
    }
    return good && std::isfinite(s.conic_a()) && std::isfinite(s.conic_b()) &&
           std::isfinite(s.conic_c());
}

bool is_sound(const FrameWorkload& frame) {
    return frame.tile_size > 0 && frame.tiles_x == frame.grid().tiles_x() &&
           frame.tiles_y == frame.grid().tiles_y() && frame.sh_degree >= 0 &&
           frame.sh_degree <= kMostShDegree &&
           adds_up(frame.culled, frame.splats.size(), frame.gaussians) && has_sound_splats(frame) &&
           has_sound_lists(frame);
}

} // namespace degs::sim
