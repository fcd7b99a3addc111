// SPDX-License-Identifier: Apache-2.0
// degs scene info | cameras | generate | convert | tile
#include <filesystem>
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "scene/dynamic/spacetime_ply.hpp"
#include "scene/dynamic/synthetic_dynamic.hpp"
#include "scene/scene_formats.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "sim/report/scene_words.hpp"
#include "sim/scene/command_tile.hpp"
#include "sim/scene/scene_cameras.hpp"
#include "sim/scene/scene_out_option.hpp"
#include "sim/scene/scene_output.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/shell/rule_options.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/warnings.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/frame_warnings.hpp"
#include "sim/view/view.hpp"
#include "splat/frame/rendering_rules.hpp"

namespace degs::sim {
namespace {

struct InfoOptions {
    ViewRequest view;
    CLI::Option* camera = nullptr;
    std::string preview;
    RenderingRules rules;
    bool json = false;
};

/// Measures the view and draws it, each if it was asked for.
std::optional<ViewStatistics> measure(const InfoOptions& options, const View& loaded) {
    const ProjectionOptions projection = options.rules.options(loaded.scene.traits.antialiased);
    std::optional<ViewStatistics> statistics;
    std::optional<CullCounts> culled;
    if (!options.preview.empty()) {
        culled = write_preview(loaded.scene, loaded.camera, projection, options.preview);
    }
    if (options.camera->count() != 0) {
        const Progress progress("measuring the view");
        statistics = measure_view(loaded.scene.cloud, loaded.camera, projection);
        culled = statistics->culled;
    }
    if (culled) {
        print_warnings(near_plane_warnings(*culled, projection, loaded.scene.cloud.size()));
    }
    return statistics;
}

void run_info(const InfoOptions& options) {
    const View loaded = load_view(options.view);
    print_warnings(loaded.scene.notes);
    const std::optional<ViewStatistics> statistics = measure(options, loaded);
    if (options.json) {
        nlohmann::ordered_json json = scene_info_json(loaded.scene);
        if (statistics) {
            json["view"] = view_info_json(*statistics, loaded.camera);
        }
        print(json_text(json));
        return;
    }
    print(scene_info(loaded.scene));
    if (statistics) {
        print(view_info(*statistics, loaded.camera));
    }
}

void add_info(CLI::App& scene) {
    auto options = std::make_shared<InfoOptions>();
    CLI::App* command =
        scene.add_subcommand("info", "statistics of a scene and, with --camera, of a view");
    ViewRequest& view = options->view;
    add_scene_argument(*command, view.scene);
    add_camera_file_option(*command, view.camera_file);
    options->camera = command
                          ->add_option_function<std::string>(
                              "--camera,--cameras",
                              [&view](const std::string& text) { view.camera = one_camera(text); },
                              "view to measure, from 0")
                          ->type_name("POSITION");
    command->add_option("--width", view.width, "image width of the view in pixels");
    add_resolution_option(*command, view.resolution);
    command
        ->add_option("--preview", options->preview,
                     "draw the view (the first camera's without --camera) with the reference "
                     "renderer, in double precision")
        ->type_name("FILE.png");
    command->add_flag("--json", options->json, "print JSON");
    add_near_option(*command, options->rules.near);
    add_projection_options(*command, options->rules);
    command->callback([options] { run_info(*options); });
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
    add_scene_out(*command, options->out, writable_scene_extensions());
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
    add_scene_argument(*command, options->in);
    add_scene_out(*command, options->out, writable_scene_extensions());
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
