// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "base/grouped_number.hpp"
#include "degs/error.hpp"
#include "scene/cameras/camera_file.hpp"
#include "scene/cameras/orbit_camera.hpp"
#include "scene/cameras/trained_frame.hpp"
#include "scene/dynamic/spacetime_ply.hpp"
#include "scene/dynamic_scene.hpp"
#include "scene/files/activation_scan.hpp"
#include "scene/files/input_file.hpp"
#include "scene/scene_cameras.hpp"
#include "scene/scene_formats.hpp"
#include "scene/scene_spec.hpp"
#include "scene/synthetic/synthetic.hpp"

namespace degs {
namespace {

namespace fs = std::filesystem;

std::string name_of(const fs::path& file) {
    const fs::path absolute = absolute_path(file);
    if (is_training_output(absolute.string())) {
        return absolute.parent_path().parent_path().parent_path().filename().string();
    }
    return file.stem() == "scene" || file.filename() == "meta.json" ||
                   file.filename() == "lod-meta.json"
               ? absolute.parent_path().filename().string()
               : file.stem().string();
}

constexpr std::uint64_t kWorthANote = 100; ///< one Gaussian in so many is dropped

std::string reasons_of(const SanitizeReport& dropped) {
    return grouped(dropped.non_finite) + " hold NaN or infinity, " +
           grouped(dropped.zero_rotation) + " a rotation of length zero, " +
           grouped(dropped.bad_scale) + " a negative scale, " + grouped(dropped.bad_opacity) +
           " an opacity outside 0 to 1";
}

/// Rows of zeros or NaN are what an export could not write, and say nothing of the others. Scales
/// and opacities out of their ranges in half of a file or more say that all were misread.
void judge_dropped(Scene& scene, std::uint64_t total) {
    const SanitizeReport& dropped = scene.dropped;
    const std::string count = grouped(dropped.total()) + " of the " + grouped(total) +
                              " Gaussians of the file cannot be drawn";
    if (dropped.total() == total) {
        fail_file(scene.source, "none of the " + grouped(total) +
                                    " Gaussians can be drawn: " + reasons_of(dropped) + ".");
    }
    if (2 * (dropped.bad_scale + dropped.bad_opacity) >= total) {
        fail_file(scene.source,
                  count + ": " + reasons_of(dropped) +
                      "; they seem to be logarithms and logits, where the format has linear "
                      "scales and opacities.");
    }
    if (dropped.total() > 0 && kWorthANote * dropped.total() >= total) {
        scene.notes.push_back(count + " and were dropped: " + reasons_of(dropped) + ".");
    }
}

void sanitize_scene(Scene& scene) {
    const std::size_t before = scene.cloud.size();
    if (before == 0) {
        fail_file(scene.source, "the scene holds no Gaussians; at least one is needed.");
    }
    scene.dropped = sanitize(scene.cloud);
    judge_dropped(scene, before);
}

std::string point_text(const glm::dvec3& point) {
    char text[80];
    std::snprintf(text, sizeof text, "(%.4g, %.4g, %.4g)", point.x, point.y, point.z);
    return text;
}

std::string generated_view_note(const OrbitView& view) {
    const glm::dvec2 angles = field_of_view(view.camera);
    char degrees[40];
    std::snprintf(degrees, sizeof degrees, "%.3g x %.3g degrees", angles.x, angles.y);
    return "The scene has no cameras; the generated view is at " +
           point_text(view.camera.position) + ", looks at " + point_text(view.target) +
           " and sees " + degrees + ".";
}

SyntheticSpec synthetic_of(const SceneSpec& spec) {
    return parse_synthetic(spec.path.substr(spec.path.find(':') + 1));
}

/// The file that is read: the first one of a sequence.
std::string file_of(const SceneSpec& spec) {
    const std::vector<std::string> files = sequence_files(spec.path);
    return files.empty() ? spec.path : files.front();
}

/// A file at the time that the user names, else at its beginning.
SceneContent content_of(const SceneSpec& spec) {
    const std::string file = file_of(spec);
    if (!is_spacetime_ply(file)) {
        if (spec.time || spec.frames) {
            fail_file(spec.path, std::string("this scene is not a function of time; '?") +
                                     (spec.time ? "time" : "frames") +
                                     "=' is for files of SpacetimeGaussians.");
        }
        return read_scene_file(file, spec.detail);
    }
    if (spec.detail.asked()) {
        return read_scene_file(file, spec.detail); // says that it has no levels
    }
    SpacetimeCloud scene = read_spacetime_ply(file);
    SceneContent content;
    ActivationScan scan;
    for (const SpacetimeGaussian& g : scene) {
        scan.add_opacity(g.opacity);
        scan.add_scale(std::min({g.log_scale.x, g.log_scale.y, g.log_scale.z}));
    }
    if (const std::uint64_t dropped = sanitize(scene); dropped > 0) {
        content.notes.push_back(std::to_string(dropped) +
                                " Gaussians hold NaN or infinity and are left out at all times.");
    }
    content.cloud = at_time(scene, spec.time.value_or(0));
    if (std::string note = activated_note(scan, content.cloud); !note.empty()) {
        content.notes.insert(content.notes.begin(), std::move(note));
    }
    return content;
}

/// Turns everything to RDF, the axes of cameras.json.
void turn(SceneContent& content, const std::optional<Axes>& told) {
    if (content.axes_assumed && !told) {
        content.notes.insert(content.notes.begin(),
                             "The file does not say which way its axes point; " +
                                 content.axes.name() +
                                 " was assumed. If the image stands on its head, '?axes=rdf' "
                                 "behind the name of the file helps.");
    }
    const Axes from = told.value_or(content.axes);
    convert_axes(content.cloud, from, Axes{});
    convert_axes(content.cameras, from, Axes{});
}

} // namespace

std::string scene_name(const std::string& spec) {
    const SceneSpec asked = parse_scene_spec(spec);
    if (asked.synthetic) {
        return synthetic_of(asked).profile;
    }
    const std::vector<std::string> files = sequence_files(asked.path);
    return files.empty() ? name_of(asked.path)
                         : absolute_path(files.front()).parent_path().filename().string();
}

namespace {

Scene scene_of(const std::string& spec, const std::string& cameras_path) {
    const SceneSpec asked = parse_scene_spec(spec);
    Scene scene;
    scene.source = spec;
    std::string cameras = cameras_path;
    if (asked.synthetic) {
        SyntheticScene made = make_synthetic(synthetic_of(asked));
        scene.cloud = std::move(made.cloud);
        scene.cameras = std::move(made.cameras);
    } else {
        SceneContent content = content_of(asked);
        turn(content, asked.axes);
        scene.cloud = std::move(content.cloud);
        scene.cameras = std::move(content.cameras);
        scene.traits = content.traits;
        scene.notes = std::move(content.notes);
        cameras = cameras.empty() ? cameras_beside(file_of(asked)) : cameras;
    }
    scene.name = scene_name(spec);
    sanitize_scene(scene);
    if (!cameras.empty()) {
        CameraFile file = read_camera_file(cameras);
        if (!asked.synthetic) {
            move_into_trained_frame(trained_frame_beside(file_of(asked)), file);
        }
        scene.cameras = std::move(file.cameras);
        scene.generated_view = file.generated;
        scene.notes.insert(scene.notes.end(), file.notes.begin(), file.notes.end());
    }
    if (scene.cameras.empty()) {
        const OrbitView view = orbit_view(scene.cloud);
        scene.cameras.push_back(view.camera);
        scene.generated_view = true;
        scene.notes.push_back(generated_view_note(view));
    }
    return scene;
}

} // namespace

Scene load_scene(const std::string& spec, const std::string& cameras_path) {
    const InputWatch watch;
    try {
        Scene scene = scene_of(spec, cameras_path);
        watch.require_unchanged();
        return scene;
    } catch (const InputError&) {
        watch.require_unchanged(); // a mixture of two files need not be a scene
        throw;
    }
}

std::vector<Camera> cameras_of_scene(const std::string& spec, const std::string& cameras_path) {
    const InputWatch watch;
    const SceneSpec asked = parse_scene_spec(spec);
    std::string cameras = cameras_path;
    if (cameras.empty() && asked.synthetic) {
        return load_scene(spec).cameras;
    }
    if (!asked.synthetic) {
        const InputFile exists(file_of(asked));
        cameras = cameras.empty() ? cameras_beside(file_of(asked)) : cameras;
    }
    std::vector<Camera> found =
        cameras.empty() ? read_scene_cameras(file_of(asked)) : read_camera_file(cameras).cameras;
    watch.require_unchanged();
    return found;
}

std::size_t camera_count(const std::string& spec, const std::string& cameras_path) {
    return std::max<std::size_t>(cameras_of_scene(spec, cameras_path).size(), 1);
}

Camera select_camera(const Scene& scene, int index) {
    if (index < 0 || index >= static_cast<int>(scene.cameras.size())) {
        throw InputError("Camera " + std::to_string(index) + " does not exist: scene '" +
                         scene.source + "' has " + std::to_string(scene.cameras.size()) +
                         " camera(s), numbered from 0.");
    }
    return scene.cameras[index];
}

} // namespace degs
