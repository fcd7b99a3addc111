// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/scene_output.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

#include "base/ratio.hpp"
#include "base/visible_text.hpp"
#include "config/input_files.hpp"
#include "degs/error.hpp"
#include "scene/cameras/camera_file.hpp"
#include "scene/files/image_io.hpp"
#include "scene/scene_formats.hpp"
#include "sim/report/report.hpp"
#include "sim/report/scene_words.hpp"
#include "sim/scene/scene_cameras.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/warnings.hpp"
#include "sim/text/words.hpp"
#include "sim/view/frame_facts.hpp"
#include "splat/reference/reference_renderer.hpp"

namespace degs::sim {
namespace {

namespace fs = std::filesystem;
using SceneJson = nlohmann::ordered_json;

/// Whether the file holds these cameras: the scene has them from it, or it is what would be
/// written. Does not read it as an input, which no output may replace.
bool holds(const std::string& camera_file, const std::vector<Camera>& cameras) {
    if (input_at(camera_file)) {
        return true;
    }
    const std::string wanted = json_text(cameras_json(cameras, false));
    std::error_code error;
    if (!fs::is_regular_file(camera_file, error) ||
        fs::file_size(camera_file, error) != wanted.size()) {
        return false;
    }
    std::ifstream file(camera_file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {}) == wanted;
}

/// Another scene in the folder of `file` that reads the same camera file; empty if there is none.
std::string namesake_of(const std::string& file) {
    const fs::path own(file);
    const std::vector<std::string> extensions = scene_extensions();
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(parent_folder(file), error)) {
        const fs::path other = entry.path().filename();
        if (other != own.filename() && other.stem() == own.stem() &&
            std::find(extensions.begin(), extensions.end(), other.extension().string()) !=
                extensions.end()) {
            return entry.path().string();
        }
    }
    return "";
}

/// Whether the scene's camera file is there and right. Throws InputError if the scene would be
/// drawn with the cameras of another one, or another scene with its.
bool stays_as_it_is(const std::string& file, const std::string& own,
                    const std::vector<Camera>& cameras) {
    std::error_code error; // a name with the ending of such files may be too long
    if (!fs::exists(own, error)) {
        return false;
    }
    if (cameras.empty()) {
        throw InputError("The scene file '" + file + "' would be drawn with the cameras of '" +
                         own +
                         "', and the scene has none; remove that file, or choose another name.");
    }
    if (holds(own, cameras)) {
        return true;
    }
    if (const std::string other = namesake_of(file); !other.empty()) {
        throw InputError("The cameras of the scene file '" + file + "' would replace those in '" +
                         own + "', with which '" + other +
                         "' is drawn as well; choose another name.");
    }
    return false;
}

/// What `file`, which has been written with these cameras of its own, is drawn with.
std::string camera_words(const std::string& file, const std::vector<Camera>& cameras, bool stays) {
    const std::string beside = cameras_beside(file);
    if (cameras.empty()) {
        return beside.empty() ? "The scene has no cameras, and none are written; every command "
                                "generates a view."
                              : "The scene has no cameras; those of " + visible(beside) +
                                    ", which is there already, are used.";
    }
    return visible(beside) + ": " +
           (stays ? "exists already and stays as it is"
                  : std::to_string(cameras.size()) + " camera(s)");
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
    const fs::path own(own_camera_file(file));
    const bool stays = stays_as_it_is(file, own.string(), cameras);
    std::vector<std::string> files{fs::path(file).filename().string()};
    if (!stays && !cameras.empty()) {
        files.push_back(own.filename().string());
    }
    const OutputFolder folder(parent_folder(file), files);
    folder.replace([&] {
        write();
        if (files.size() > 1) {
            folder.write_json(files.back(), cameras_json(cameras, false));
        }
    });
    print(visible(file) + ": " + visible(words) + "\n" + camera_words(file, cameras, stays) + "\n");
}

void write_scene(const Scene& scene, const std::string& file) {
    const std::vector<Camera> own = scene.generated_view ? std::vector<Camera>() : scene.cameras;
    write_scene(file, scene_words(facts_of(scene)), own,
                [&] { print_warnings(write_scene_file(scene.cloud, own, scene.traits, file)); });
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
    json["cameras"] = cameras_json(scene.cameras, scene.generated_view);
    return json;
}

SceneJson view_info_json(const ViewStatistics& v, const Camera& camera) {
    return {{"camera", camera_json(camera)},
            {"visible", v.visible},
            {"tile_pairs", v.tile_pairs},
            {"fragments", v.fragments},
            {"candidates", v.candidates},
            {"fragments_per_pixel", v.fragments_per_pixel},
            {"fragments_per_splat",
             v.visible > 0 ? SceneJson(ratio_of(v.fragments, v.visible)) : SceneJson(nullptr)},
            {"candidates_per_pixel", v.candidates_per_pixel},
            {"terminated_share", v.terminated_share},
            {"covered_share", v.covered_share},
            {"footprint_px", quantiles_json(v.footprint)},
            {"footprint_gini", v.footprint_gini}};
}

CullCounts write_preview(const Scene& scene, const Camera& camera, const ProjectionOptions& options,
                         const std::string& file) {
    constexpr int kTileSide = 16;
    refuse_output_in_use(file);
    const Progress progress("rendering the preview");
    ReferenceCounts counts;
    const FrameWorkload frame =
        make_frame_workload(scene.cloud, camera, kTileSide, TileMode::Exact, options);
    write_png(render_reference(frame, counts), file);
    return frame.culled;
}

} // namespace degs::sim
