// SPDX-License-Identifier: Apache-2.0
// degs compare: several accelerators on the same views.
#include <memory>

#include "config/visible_text.hpp"
#include "sim/commands.hpp"
#include "sim/compare/compare_session.hpp"
#include "sim/compare/comparison_output.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/view_options.hpp"
#include "sim/warnings.hpp"

namespace degs::sim {
namespace {

struct CompareOptions {
    std::vector<std::string> configs, overrides, scenes;
    std::string cameras = "0";
    std::string camera_file;
    std::string resolutions;
    std::optional<int> width;
    PathRequest path;
    bool array_only = false;
    bool no_reference = false;
    std::optional<std::string> within;
    std::uint64_t seed = 1;
    int jobs = 1;
    std::string out = "out";
};

CompareRequest request_of(const CompareOptions& options) {
    CompareRequest request;
    request.configs = load_configs(options.configs, options.overrides);
    check_scenes(options.scenes);
    request.scenes = options.scenes;
    request.cameras = parse_cameras(options.cameras);
    request.camera_file = options.camera_file;
    if (!options.resolutions.empty()) {
        request.sizes = parse_resolutions(options.resolutions);
    } else {
        request.sizes = {ImageSize{options.width, {}}};
    }
    request.path = options.path;
    request.array_only = options.array_only;
    request.reference = !options.no_reference;
    request.sampling = sampling_for_runs(options.within, options.seed, options.path.frames);
    request.jobs = options.jobs;
    return request;
}

void run(const CompareOptions& options) {
    const CompareRequest request = request_of(options);
    const OutputFolder out(options.out, comparison_files());
    std::size_t shown = 0; // views
    CompareSession session(request, out, [&shown](const Comparison& now, std::size_t views) {
        print(views_text(now, shown, views));
        shown = views;
    });
    const Comparison comparison = session.run();
    print(views_text(comparison, shown, comparison.views.size()) + closing_text(comparison));
    if (!comparison.rows.empty()) {
        print("all numbers and pictures: " + visible(out.path("")) + "\n");
    }
    print_warnings(session.warnings());
    if (const std::optional<Failure> failure = session.failure()) {
        throw FailureError(*failure);
    }
}

void add_what_options(CLI::App& command, CompareOptions& options) {
    command
        .add_option("config", options.configs,
                    "configuration files (YAML), each as FILE or NAME=FILE; the others are "
                    "compared with the first")
        ->type_name("FILE")
        ->required();
    command
        .add_option("--scene", options.scenes,
                    "scene file, or synthetic:NAME[,gaussians=N][,seed=N]; may be repeated")
        ->type_name("SCENE")
        ->required()
        ->take_all()
        ->expected(1);
    command
        .add_option("--camera,--cameras", options.cameras,
                    "positions in the scene's list of cameras, from 0: 0,2 or all")
        ->type_name("LIST")
        ->capture_default_str();
    add_camera_file_option(command, options.camera_file);
    CLI::Option* resolution =
        command
            .add_option("--resolution", options.resolutions,
                        "720p, 1080p, 2k, 4k, 8k, or several separated by commas; else the "
                        "cameras' own")
            ->type_name("NAMES");
    command.add_option("--width", options.width, "image width in pixels; the views are scaled")
        ->excludes(resolution);
    add_path_options(command, options.path);
    add_sampling_options(command, options.within, options.seed);
    add_addressed_overrides_option(command, options.overrides);
    command.add_flag("--array-only", options.array_only,
                     "the rasterisation arrays alone: sorted lists are there at once, and memory "
                     "is unlimited");
}

} // namespace

void add_compare_command(CLI::App& program) {
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command =
        program.add_subcommand("compare", "compare accelerators on the same frames");
    add_what_options(*command, *options);
    command->add_flag("--no-reference", options->no_reference,
                      "do not render the double-precision images to compare with");
    command->add_option("--jobs", options->jobs, "simulations at a time, each in its own process")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    add_out_option(*command, options->out, "folder for tables, pictures and reports");
    command->callback([options] { run(*options); });
}

} // namespace degs::sim
