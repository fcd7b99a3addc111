// SPDX-License-Identifier: Apache-2.0
#include "sim/cache/entry_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace degs::sim {
bool is_sound(const SceneCard& card) {
    const SceneFacts& facts = card.facts;
    constexpr std::uint64_t kMost = std::uint64_t{1} << 40; // Gaussians of a file
    const SanitizeReport& d = facts.dropped;
    return facts.gaussians >= 1 && facts.gaussians < kMost && facts.sh_degree >= 0 &&
           facts.sh_degree <= kMostShDegree && d.non_finite < kMost && d.zero_rotation < kMost &&
           d.bad_scale < kMost && d.bad_opacity < kMost && !card.cameras.empty() &&
           std::all_of(card.cameras.begin(), card.cameras.end(),
                       [](const Camera& camera) { return is_sound(camera); });
}

bool is_sound(const Reference& reference, const FrameWorkload& frame) {
    const Image& image = reference.image;
    if (image.width != frame.camera.width || image.height != frame.camera.height ||
        image.rgb.size() != 3 * image.pixels() || image.transmittance.size() != image.pixels() ||
        image.fragments.size() != image.pixels()) {
        return false;
    }
    const std::uint64_t fragments =
        std::accumulate(image.fragments.begin(), image.fragments.end(), std::uint64_t{0});
    return fragments == reference.counts.fragments &&
           reference.counts.terminated <= image.pixels() && reference.render_s >= 0 &&
           std::isfinite(reference.render_s) &&
           std::all_of(image.rgb.begin(), image.rgb.end(),
                       [](float c) { return std::isfinite(c) && c >= 0; }) &&
           std::all_of(image.transmittance.begin(), image.transmittance.end(),
                       [](float t) { return t >= 0 && t <= 1; });
}

} // namespace degs::sim
