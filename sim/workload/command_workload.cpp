// SPDX-License-Identifier: Apache-2.0
// degs workload
#include <memory>

#include <nlohmann/json.hpp>

#include "config/config_document.hpp"
#include "sim/cache/cached_view.hpp"
#include "sim/design/run_config.hpp"
#include "sim/report/report.hpp"
#include "sim/report/scene_words.hpp"
#include "sim/report/terminal.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/warnings.hpp"
#include "sim/text/words.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/frame_warnings.hpp"
#include "sim/view/view.hpp"
#include "sim/workload/command_pack.hpp"
#include "sim/workload/workload_export.hpp"

namespace degs::sim {
namespace {

struct ExportOptions {
    std::string config;
    std::vector<std::string> overrides;
    ViewRequest view;
    std::string out = "out";
    bool no_cache = false;
};

nlohmann::ordered_json file_json(const ExportedFile& file) {
    return {{"name", file.name}, {"records", file.records}, {"xxh128", file.xxh128}};
}

nlohmann::ordered_json workload_document(const RunConfig& config, const SceneFacts& scene,
                                         const Camera& camera, const ExportedWorkload& work) {
    nlohmann::ordered_json json;
    json["schema"] = {{"name", "degs-workload"}, {"version", 1}};
    json["tool"] = tool_json();
    json["design"] = config.accelerator().name;
    json["config"] = resolved(config);
    json["scene"] = scene_json(scene);
    json["camera"] = camera_json(camera);
    json["tiles"] = {{"size_px", work.tile_size},
                     {"columns", work.tiles_x},
                     {"rows", work.tiles_y},
                     {"listed", work.tiles}};
    json["splats"] = work.splats;
    json["pixels"] = work.pixels;
    json["files"] = {file_json(work.lists), file_json(work.rows)};
    return json;
}

void run_export(const ExportOptions& options) {
    const RunConfig config = load_run_config(options.config, options.overrides, "");
    const AcceleratorConfig& design = config.accelerator();
    CachedView view(options.view, PathRequest(),
                    options.no_cache ? FrameCache() : FrameCache::of_user());
    const OutputFolder out(options.out, workload_files());
    const std::vector<FramePointer> frames = view.first_frame(design);
    view.keep(frames, {});
    view.forget_cloud();
    const FrameWorkload& frame = *frames.front();
    ExportedWorkload work;
    out.replace([&] {
        const Progress progress("writing the workload");
        work = export_workload(frame, design, out);
        out.write_json("workload.json",
                       workload_document(config, view.facts(), frame.camera, work));
    });
    print_warnings(config.warnings);
    print_warnings(view.facts().notes);
    print_warnings(near_plane_warnings(frame));
    print(layout({{"scene", scene_words(view.facts()) + " · " + grouped(work.splats) + " visible"},
                  {"design", design.name + " · tiles of " + std::to_string(work.tile_size) + " px"},
                  {"lists", grouped(work.lists.records) + " entries in " + grouped(work.tiles) +
                                " tiles · " + out.path(work.lists.name)},
                  {"rows", grouped(work.rows.records) + " rows of " + scaled(work.pixels) +
                               " pixels · " + out.path(work.rows.name)}}));
}

} // namespace

void add_workload_command(CLI::App& program) {
    CLI::App* workload =
        program.add_subcommand("workload", "write what an array has to do, for other programs");
    workload->require_subcommand(1);
    auto options = std::make_shared<ExportOptions>();
    CLI::App* command = workload->add_subcommand(
        "export", "write the tile lists of a frame, and the rows of its splats in every tile");
    add_config_option(*command, options->config)->required();
    add_view_or_workload_options(*command, options->view);
    add_out_option(*command, options->out, "folder for workload.json, lists.csv and rows.csv");
    add_overrides_option(*command, options->overrides);
    command->add_flag("--no-cache", options->no_cache,
                      "neither read nor keep the frame of an earlier run");
    command->callback([options] { run_export(*options); });
    add_pack_command(*workload);
}

} // namespace degs::sim
