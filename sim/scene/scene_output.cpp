// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/scene_output.hpp"

#include <filesystem>

#include <nlohmann/json.hpp>

#include "config/visible_text.hpp"
#include "scene/image_io.hpp"
#include "scene/scene_formats.hpp"
#include "scene/scene_statistics.hpp"
#include "sim/output_folder.hpp"
#include "sim/report.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/scene_words.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/words.hpp"
#include "sim/warnings.hpp"
#include "splat/frame/rendering_rules.hpp"
#include "splat/reference_renderer.hpp"

namespace degs::sim {
namespace {

using SceneJson = nlohmann::ordered_json;

/// The folder of a file that is going to be written; "." if it has none.
std::string folder_of(const std::string& file) {
    const std::string folder = std::filesystem::path(file).parent_path().string();
    return folder.empty() ? "." : folder;
}

SceneJson quantiles_json(const Quantiles& q) {
    return {{"p10", q.p10}, {"p50", q.p50}, {"p90", q.p90}, {"p99", q.p99}};
}

SceneJson vector_json(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

} // namespace

void write_scene(const std::string& file, const std::string& words,
                 const std::vector<Camera>& cameras, const std::function<void()>& write) {
    const OutputFolder folder(folder_of(file), {std::filesystem::path(file).filename().string()});
    const std::string beside = folder.path("cameras.json");
    std::string said = visible(file) + ": " + visible(words) + "\n" + visible(beside) + ": ";
    folder.replace([&] {
        write();
        if (std::filesystem::exists(beside)) {
            said += "exists already and stays as it is\n";
            return;
        }
        SceneJson list = SceneJson::array();
        for (const Camera& camera : cameras) {
            list.push_back(camera_json(camera));
        }
        folder.write_json("cameras.json", list);
        said += std::to_string(cameras.size()) + " camera(s)\n";
    });
    print(said);
}

void write_scene(const Scene& scene, const std::string& file) {
    write_scene(file, scene_words(facts_of(scene)), scene.cameras, [&] {
        print_warnings(write_scene_file(scene.cloud, scene.cameras, scene.traits, file));
    });
}

SceneJson scene_info_json(const Scene& scene) {
    const SceneStatistics s = measure_scene(scene.cloud, scene.dropped);
    SceneJson json;
    json["schema"] = {{"name", "degs-scene"}, {"version", 1}};
    json["scene"] = scene_json(facts_of(scene));
    json["notes"] = scene.notes;
    json["antialiased"] = scene.traits.antialiased;
    json["statistics"] = {{"low", vector_json(s.low)},
                          {"high", vector_json(s.high)},
                          {"largest_axis", quantiles_json(s.largest_axis)},
                          {"largest_axis_max", s.largest_axis_max},
                          {"anisotropy", quantiles_json(s.anisotropy)},
                          {"elongation", quantiles_json(s.elongation)},
                          {"opacity", quantiles_json(s.opacity)},
                          {"opaque_share", s.opaque_share},
                          {"faint_share", s.faint_share},
                          {"sh_rest_rms", s.sh_rest_rms}};
    json["cameras"] = SceneJson::array();
    for (const Camera& camera : scene.cameras) {
        json["cameras"].push_back(camera_json(camera));
    }
    return json;
}

SceneJson view_info_json(const Scene& scene, const Camera& camera) {
    const Progress progress("measuring the view");
    const ViewStatistics v =
        measure_view(scene.cloud, camera, RenderingRules().options(scene.traits.antialiased));
    return {{"camera", camera_json(camera)},
            {"visible", v.visible},
            {"tile_pairs", v.tile_pairs},
            {"fragments", v.fragments},
            {"candidates", v.candidates},
            {"fragments_per_pixel", v.fragments_per_pixel},
            {"candidates_per_pixel", v.candidates_per_pixel},
            {"terminated_share", v.terminated_share},
            {"covered_share", v.covered_share},
            {"footprint_px", quantiles_json(v.footprint)}};
}

void write_preview(const Scene& scene, const Camera& camera, const std::string& file) {
    constexpr int kTileSide = 16;
    refuse_output_in_use(file);
    const Progress progress("rendering the preview");
    ReferenceCounts counts;
    write_png(
        render_reference(make_frame_workload(scene.cloud, camera, kTileSide, TileMode::Exact,
                                             RenderingRules().options(scene.traits.antialiased)),
                         counts),
        file);
}

} // namespace degs::sim
