// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/scene_cameras.hpp"

#include <filesystem>
#include <memory>

#include <nlohmann/json.hpp>

#include "base/visible_text.hpp"
#include "scene/cameras/lens_terms.hpp"
#include "scene/cameras/orbit_camera.hpp"
#include "sim/report/report.hpp"
#include "sim/report/scene_words.hpp"
#include "sim/report/terminal.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/warnings.hpp"
#include "sim/text/words.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {
namespace {

/// " · lens OPENCV, 12.3 px in the corner"; empty for a pinhole.
std::string lens_words(const Camera& camera) {
    return camera.lens.is_pinhole()
               ? ""
               : std::string(" · lens ") + camera.lens.name() + ", " +
                     three_digits(corner_shift(camera)) + " px in the farthest corner";
}

void list_cameras(const ViewRequest& view, const std::string& out) {
    check_view(view);
    const Scene scene = load_scene(view.scene, view.camera_file);
    print_warnings(scene.notes);
    print(cameras_text(scene));
    if (!out.empty()) {
        const std::string name = std::filesystem::path(out).filename().string();
        const OutputFolder target(parent_folder(out), {name});
        target.write_json(name, cameras_json(scene.cameras, scene.generated_view));
        print(visible(out) + ": " + std::to_string(scene.cameras.size()) +
              (scene.generated_view ? " generated view(s)" : " camera(s)") + "\n");
    }
}

} // namespace

nlohmann::ordered_json cameras_json(const std::vector<Camera>& cameras, bool generated) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Camera& camera : cameras) {
        list.push_back(camera_json(camera));
        if (generated) {
            list.back()["generated"] = true;
        }
    }
    return list;
}

std::string cameras_text(const Scene& scene) {
    Block block;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        const Camera& camera = scene.cameras[i];
        const glm::dvec2 angles = field_of_view(camera);
        block.emplace_back(
            "camera " + std::to_string(i),
            size_words(camera) + " " + camera.name + (scene.generated_view ? " (generated)" : "") +
                " · at " + point_words(camera.position) + " · looks along " +
                point_words(camera.camera_to_world[2]) + " · sees " + three_digits(angles.x) +
                "° × " + three_digits(angles.y) + "°" + lens_words(camera));
    }
    return layout(block);
}

void add_scene_cameras(CLI::App& scene) {
    struct Options {
        ViewRequest view;
        std::string out;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = scene.add_subcommand(
        "cameras", "list the views of a scene, and write them as cameras.json");
    add_scene_argument(*command, options->view.scene);
    add_camera_file_option(*command, options->view.camera_file);
    command->add_option("--out", options->out, "file to write, for --camera-file")
        ->type_name("FILE");
    command->callback([options] { list_cameras(options->view, options->out); });
}

} // namespace degs::sim
