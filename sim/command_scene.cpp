// SPDX-License-Identifier: Apache-2.0
// degs scene info | cameras | generate | convert | tile
#include <filesystem>
#include <memory>

#include <nlohmann/json.hpp>

#include "scene/dynamic/spacetime_ply.hpp"
#include "scene/dynamic/synthetic_dynamic.hpp"
#include "scene/scene_formats.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "sim/commands.hpp"
#include "sim/output_folder.hpp"
#include "sim/scene/command_tile.hpp"
#include "sim/scene/scene_cameras.hpp"
#include "sim/scene/scene_output.hpp"
#include "sim/text/scene_words.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/view_options.hpp"
#include "sim/warnings.hpp"

namespace degs::sim {
namespace {

void add_info(CLI::App& scene) {
    struct Options {
        ViewRequest view;
        CLI::Option* camera = nullptr;
        std::string preview;
        bool json = false;
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
    command
        ->add_option("--preview", options->preview,
                     "draw the view (the first camera's without --camera) with the reference "
                     "renderer, in double precision")
        ->type_name("FILE.png");
    command->add_flag("--json", options->json, "print JSON");
    command->callback([options] {
        const View loaded = load_view(options->view);
        const bool with_view = options->camera->count() != 0;
        print_warnings(loaded.scene.notes);
        if (!options->preview.empty()) {
            write_preview(loaded.scene, loaded.camera, options->preview);
        }
        if (options->json) {
            nlohmann::ordered_json json = scene_info_json(loaded.scene);
            if (with_view) {
                json["view"] = view_info_json(loaded.scene, loaded.camera);
            }
            print(json_text(json));
            return;
        }
        print(scene_info(loaded.scene));
        if (with_view) {
            print(view_info(loaded.scene, loaded.camera));
        }
    });
}

void add_generate(CLI::App& scene) {
    struct Options {
        std::string profile, gaussians, seed = "1", out;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = scene.add_subcommand("generate", "write a synthetic scene as a file");
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
    command
        ->add_option("--out", options->out, "file to write (" + writable_scene_extensions() + ")")
        ->type_name("FILE")
        ->required();
    command->callback([options] {
        check_scene_writable(options->out);
        std::string spec = "synthetic:" + options->profile + ",seed=" + options->seed;
        if (!options->gaussians.empty()) {
            spec += ",gaussians=" + options->gaussians;
        }
        const Scene made = load_scene(spec);
        write_scene(options->out, scene_words(facts_of(made)), made.cameras, [&] {
            // A PLY file has all times, other formats the first alone.
            if (options->profile == kSyntheticDynamic &&
                std::filesystem::path(options->out).extension() == ".ply") {
                const std::string profile = spec.substr(spec.find(':') + 1);
                write_spacetime_ply(make_spacetime(parse_synthetic(profile)), options->out);
            } else {
                print_warnings(
                    write_scene_file(made.cloud, made.cameras, made.traits, options->out));
            }
        });
    });
}

void add_convert(CLI::App& scene) {
    struct Options {
        std::string in, out;
    };
    auto options = std::make_shared<Options>();
    CLI::App* command = scene.add_subcommand(
        "convert", "write a scene in another format, without the Gaussians that cannot be drawn");
    command->add_option("scene", options->in, "scene file, or synthetic:NAME[,...]")
        ->type_name("SCENE")
        ->required();
    command
        ->add_option("--out", options->out, "file to write (" + writable_scene_extensions() + ")")
        ->type_name("FILE")
        ->required();
    command->callback([options] {
        check_scene_writable(options->out);
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
    add_scene_tile(*scene);
}

} // namespace degs::sim
