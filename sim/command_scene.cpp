// SPDX-License-Identifier: Apache-2.0
// degs scene info | generate | convert
#include <filesystem>
#include <memory>

#include <nlohmann/json.hpp>

#include "config/error.hpp"
#include "config/visible_text.hpp"
#include "scene/ply/ply.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "sim/commands.hpp"
#include "sim/output_folder.hpp"
#include "sim/report.hpp"
#include "sim/scene/scene_cameras.hpp"
#include "sim/text/scene_words.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/view_options.hpp"
#include "sim/warnings.hpp"

namespace degs::sim {
namespace {

namespace fs = std::filesystem;

/// The folder of a file that is going to be written; "." if it has none.
std::string folder_of(const std::string& file) {
    const std::string folder = fs::path(file).parent_path().string();
    return folder.empty() ? "." : folder;
}

void check_ply(const std::string& file) {
    if (fs::path(file).extension() != ".ply") {
        throw InputError("The scene file '" + file +
                         "' cannot be written: its name must end in "
                         ".ply.");
    }
}

/// Writes the scene and, unless there is one, cameras.json beside it.
void write_scene(const Scene& scene, const std::string& file) {
    const OutputFolder folder(folder_of(file), {fs::path(file).filename().string()});
    write_ply(scene.cloud, file);
    print(visible(file) + ": " + visible(scene_words(facts_of(scene))) + "\n");
    const std::string cameras = folder.path("cameras.json");
    if (fs::exists(cameras)) {
        print(visible(cameras) + ": exists already and stays as it is\n");
        return;
    }
    folder.write_json("cameras.json", cameras_json(scene));
    print(visible(cameras) + ": " + std::to_string(scene.cameras.size()) + " camera(s)\n");
}

void add_info(CLI::App& scene) {
    struct Options {
        ViewRequest view;
        CLI::Option* camera = nullptr;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command =
        scene.add_subcommand("info", "statistics of a scene and, with --camera, of a view");
    ViewRequest& view = options->view;
    command->add_option("scene", view.scene, "scene file, or synthetic:NAME[,...]")
        ->type_name("SCENE")
        ->required();
    add_camera_file_option(*command, view.camera_file);
    options->camera = command
                          ->add_option_function<std::string>(
                              "--camera,--cameras",
                              [&view](const std::string& text) { view.camera = one_camera(text); },
                              "view to measure, from 0")
                          ->type_name("POSITION");
    CLI::Option* width =
        command->add_option("--width", view.width, "image width of the view in pixels")
            ->needs(options->camera);
    add_resolution_option(*command, view.resolution)->needs(options->camera)->excludes(width);
    command->callback([options] {
        const View loaded = load_view(options->view);
        print_warnings(loaded.scene.notes);
        print(scene_info(loaded.scene));
        if (options->camera->count() != 0) {
            print(view_info(loaded.scene, loaded.camera));
        }
    });
}

void add_generate(CLI::App& scene) {
    struct Options {
        std::string profile, gaussians, seed = "1", out;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = scene.add_subcommand("generate", "write a synthetic scene as PLY");
    std::string names;
    for (const SyntheticProfile& profile : synthetic_profiles()) {
        names += (names.empty() ? "" : "; ") + profile.name + ": " + profile.meaning;
    }
    command->add_option("name", options->profile, names)->required();
    command
        ->add_option("--gaussians", options->gaussians,
                     "number of Gaussians; default: the profile's")
        ->type_name("INT");
    command->add_option("--seed", options->seed, "seed of the random numbers")
        ->type_name("INT")
        ->capture_default_str();
    command->add_option("--out", options->out, "file to write (.ply)")
        ->type_name("FILE")
        ->required();
    command->callback([options] {
        check_ply(options->out);
        std::string spec = "synthetic:" + options->profile + ",seed=" + options->seed;
        if (!options->gaussians.empty()) {
            spec += ",gaussians=" + options->gaussians;
        }
        write_scene(load_scene(spec), options->out);
    });
}

void add_convert(CLI::App& scene) {
    struct Options {
        std::string in, out;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = scene.add_subcommand(
        "convert", "write a scene as PLY, without the Gaussians that cannot be drawn");
    command->add_option("scene", options->in, "scene file, or synthetic:NAME[,...]")
        ->type_name("SCENE")
        ->required();
    command->add_option("--out", options->out, "file to write (.ply)")
        ->type_name("FILE")
        ->required();
    command->callback([options] {
        check_ply(options->out);
        const Scene loaded = load_scene(options->in);
        print_warnings(loaded.notes);
        write_scene(loaded, options->out);
    });
}

} // namespace

void add_scene_command(CLI::App& program) {
    CLI::App* scene = program.add_subcommand("scene", "measure, make or convert a scene");
    scene->require_subcommand(1);
    add_info(*scene);
    add_scene_cameras(*scene);
    add_generate(*scene);
    add_convert(*scene);
}

} // namespace degs::sim
