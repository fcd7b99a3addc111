// SPDX-License-Identifier: Apache-2.0
// degs render: the reference image in double precision, no accelerator.
#include <algorithm>
#include <memory>

#include <nlohmann/json.hpp>

#include "scene/files/image_io.hpp"
#include "sim/process/memory_use.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/report/report.hpp"
#include "sim/report/terminal.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/shell/rule_options.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/warnings.hpp"
#include "sim/text/words.hpp"
#include "sim/trace/tile_maps.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/frame_warnings.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {
namespace {

struct RenderOptions {
    ViewRequest view;
    TileMode tiles = TileMode::Exact;
    RenderingRules rules;
    int tile_size = 16;
    std::string out = "out";
};

struct RenderResult {
    SceneFacts scene;
    Camera camera;
    WorkloadFacts workload;
    Image image;
    double load_s = 0, workload_s = 0, render_s = 0;
};

RenderResult render(const RenderOptions& options, const View& view) {
    RenderResult result;
    result.scene = facts_of(view.scene);
    result.camera = view.camera;
    result.load_s = view.load_s;
    const Progress progress("reference image");
    const Stopwatch project;
    const FrameWorkload workload =
        make_frame_workload(view.scene.cloud, view.camera, options.tile_size, options.tiles,
                            options.rules.options(view.scene.traits.antialiased));
    result.workload_s = project.seconds();
    result.workload = facts_of(workload);
    const Stopwatch draw;
    ReferenceCounts counts;
    result.image = render_reference(workload, counts);
    result.render_s = draw.seconds();
    result.workload.reference = counts;
    return result;
}

nlohmann::ordered_json render_json(const RenderResult& result, double wall_s) {
    nlohmann::ordered_json json;
    json["schema"] = {{"name", "degs-render"}, {"version", kReportVersion}};
    json["tool"] = tool_json();
    json["scene"] = scene_json(result.scene);
    json["camera"] = camera_json(result.camera);
    json["workload"] = workload_json(result.workload, result.scene);
    json["host"] = {{"load_s", result.load_s},
                    {"workload_s", result.workload_s},
                    {"render_s", result.render_s},
                    {"wall_s", wall_s},
                    {"peak_rss_bytes", peak_rss_bytes()}};
    return json;
}

void run(const RenderOptions& options) {
    const Stopwatch wall;
    const View view = load_view(options.view);
    const OutputFolder out(options.out, image_result_files("render.json"));
    const RenderResult result = render(options, view);
    out.replace(
        [&] {
            write_exr(result.image, out.path("image.exr"));
            write_png(result.image, out.path("image.png"));
            out.write_json("render.json", render_json(result, wall.seconds()));
        },
        old_tile_maps(out, {}));
    const std::uint64_t fragments = result.workload.reference->fragments;
    print_warnings(result.scene.notes);
    print_warnings(lens_warnings(view.camera, result.workload.projection));
    print_warnings(near_plane_warnings(result.workload.culled, result.workload.projection,
                                       result.workload.gaussians));
    print(layout({{"scene", scene_words(result.scene) + " · " + grouped(result.workload.visible) +
                                " visible"},
                  {"frame", size_words(result.camera) + " · " + scaled(fragments) +
                                " fragments · " + out.path("image.exr")},
                  {"host", "rendering " + three_digits(result.render_s) + " s · " +
                               three_digits(wall.seconds()) + " s in all"}}));
}

} // namespace

void add_render_command(CLI::App& program) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        program.add_subcommand("render", "render the reference image in double precision");
    add_view_options(*command, options->view);
    const std::vector<const char*>& modes = tile_mode_names();
    command
        ->add_option_function<std::string>(
            "--tiles",
            [options, modes](const std::string& name) {
                const auto mode = std::find(modes.begin(), modes.end(), name);
                options->tiles = static_cast<TileMode>(mode - modes.begin());
            },
            kTileModesDoc)
        ->check(CLI::IsMember(std::vector<std::string>(modes.begin(), modes.end())))
        ->default_str(modes.front());
    add_rule_options(*command, options->rules);
    command->add_option("--tile-size", options->tile_size, "pixels")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    add_out_option(*command, options->out, "folder for image.exr, image.png and render.json");
    command->callback([options] { run(*options); });
}

} // namespace degs::sim
