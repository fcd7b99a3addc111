// SPDX-License-Identifier: Apache-2.0
#include "sim/report/scene_words.hpp"

#include "base/ratio.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

std::string quantile_words(const Quantiles& q) {
    return three_digits(q.p10) + "  " + three_digits(q.p50) + "  " + three_digits(q.p90) + "  " +
           three_digits(q.p99);
}

std::string dropped_words(const SanitizeReport& dropped) {
    if (dropped.total() == 0) {
        return "none";
    }
    return grouped(dropped.total()) + ": " + grouped(dropped.non_finite) + " not finite, " +
           grouped(dropped.zero_rotation) + " without rotation, " + grouped(dropped.bad_scale) +
           " of negative scale, " + grouped(dropped.bad_opacity) + " of impossible opacity";
}

} // namespace

std::string point_words(const glm::dvec3& p) {
    return "(" + three_digits(p.x) + ", " + three_digits(p.y) + ", " + three_digits(p.z) + ")";
}

std::string scene_info(const Scene& scene) {
    const SceneStatistics s = measure_scene(scene.cloud, scene.dropped);
    Block block = {
        {"scene", scene_words(facts_of(scene))},
        {"dropped", dropped_words(s.dropped)},
        {"extent",
         point_words(s.low) + " to " + point_words(s.high) + " (98 % of the centres, per axis)"},
        {"opacity", percent(s.opaque_share) + " % above 0.9, " + percent(s.faint_share) +
                        " % below 1/255 (never drawn)"},
        {"", "10 %  50 %  90 %  99 % of the Gaussians are below"},
        {"largest axis", quantile_words(s.largest_axis)},
        {"anisotropy", quantile_words(s.anisotropy) + "  (largest / smallest axis)"},
        {"elongation", quantile_words(s.elongation) + "  (largest / middle axis)"},
        {"opacity", quantile_words(s.opacity)},
    };
    if (scene.traits.antialiased) {
        block.emplace_back("opacities", "trained with anti-aliasing, as the file says");
    }
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        const Camera& camera = scene.cameras[i];
        block.emplace_back("camera " + std::to_string(i),
                           size_words(camera) + " " + camera.name +
                               (scene.generated_view ? " (generated)" : ""));
    }
    return layout(block);
}

std::string view_info(const ViewStatistics& v, const Camera& camera) {
    const auto per_splat = [&v](std::uint64_t count) {
        return v.visible > 0 ? three_digits(ratio_of(count, v.visible)) : "-";
    };
    return "\n" +
           layout({
               {"view", size_words(camera) + " " + camera.name},
               {"visible", grouped(v.visible) + " splats, " + scaled(v.tile_pairs) +
                               " entries in lists of 16×16 tiles"},
               {"fragments",
                scaled(v.fragments) + " · " + per_splat(v.fragments) + " per visible splat"},
               {"depth", three_digits(v.fragments_per_pixel) + " fragments per pixel, " +
                             three_digits(v.candidates_per_pixel) + " without early termination"},
               {"pixels", percent(v.terminated_share) + " % terminate early, " +
                              percent(v.covered_share) + " % are covered by more than half"},
               {"footprint", quantile_words(v.footprint) +
                                 "  px diameter; 10, 50, 90, 99 % of the splats are below"},
               {"Gini", three_digits(v.footprint_gini) + ", of the areas of the footprints"},
           });
}

} // namespace degs::sim
