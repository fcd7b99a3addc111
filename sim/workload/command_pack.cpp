// SPDX-License-Identifier: Apache-2.0
// degs workload pack
#include "sim/workload/command_pack.hpp"

#include <algorithm>
#include <memory>
#include <set>

#include "scene/files/input_file.hpp"
#include "scene/files/output_file.hpp"
#include "sim/report/terminal.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/study/compare_request.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/warnings.hpp"
#include "sim/text/words.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/view.hpp"
#include "sim/workload_file/workload_file.hpp"
#include "splat/pixels/data_path.hpp"

namespace degs::sim {
namespace {

struct PackOptions {
    std::vector<std::string> configs, overrides;
    std::string memory;
    ViewRequest view;
    std::string out;
    bool no_reference = false;
};

/// Finds the frame among those that are there, or makes it.
FrameToPack& frame_of(std::vector<FrameToPack>& frames, const View& view, int tile_size,
                      TileMode mode, const ProjectionOptions& options) {
    const auto same = [&](const FrameToPack& other) {
        return other.frame.tile_size == tile_size && other.frame.tile_mode == mode &&
               same_projection(other.frame.projection, options);
    };
    const auto found = std::find_if(frames.begin(), frames.end(), same);
    if (found != frames.end()) {
        return *found;
    }
    frames.push_back(
        {make_frame_workload(view.scene.cloud, view.camera, tile_size, mode, options), {}});
    return frames.back();
}

/// The frames of all designs, and with `references` for each the one that its reference image is
/// drawn from.
std::vector<FrameToPack> frames_for(const std::vector<NamedConfig>& designs, const View& view,
                                    bool references) {
    const Progress progress("projecting and sorting");
    std::vector<FrameToPack> frames;
    for (const NamedConfig& design : designs) {
        const AcceleratorConfig& config = design.config.accelerator();
        const int tile_size = config.tile_size_px();
        const TileMode mode = config.tile_mode();
        ProjectionOptions options =
            projection_of(config.data_path(), view.scene.traits.antialiased);
        frame_of(frames, view, tile_size, mode, options).designs.push_back(design.name);
        if (references) {
            options.numbers = ProjectionNumbers();
            frame_of(frames, view, tile_size, mode, options);
        }
    }
    return frames;
}

void run_pack(const PackOptions& options) {
    const std::vector<NamedConfig> designs =
        load_configs(options.configs, options.overrides, options.memory);
    refuse_output_in_use(options.out);
    const View view = load_view(options.view);
    const SceneFacts scene = facts_of(view.scene);
    const std::vector<FrameToPack> frames = frames_for(designs, view, !options.no_reference);
    std::string bytes;
    {
        const Progress progress("compressing");
        bytes = pack_workload(scene, frames);
    }
    refuse_output_in_use(options.out);
    write_whole(options.out, bytes);
    std::set<std::string> kinds;
    for (const FrameToPack& frame : frames) {
        if (!frame.designs.empty()) {
            kinds.insert(
                frame_words(frame.frame.projection, frame.frame.tile_size, frame.frame.tile_mode));
        }
    }
    std::string lines;
    for (const std::string& kind : kinds) {
        lines += (lines.empty() ? "" : "; ") + kind;
    }
    print_warnings(scene.notes);
    print(layout({{"scene", scene_words(scene) + " · " + size_words(view.camera)},
                  {"frames", lines},
                  {"file", options.out + " · " + grouped(bytes.size()) + " B · XXH3 " +
                               workload_checksum(bytes)}}));
}

} // namespace

void add_pack_command(CLI::App& workload) {
    auto options = std::make_shared<PackOptions>();
    CLI::App* command = workload.add_subcommand(
        "pack", "write a view into one file, from which 'degs run' needs no scene");
    command
        ->add_option("config", options->configs,
                     "configuration files (YAML) of the designs that the file is for, each as FILE "
                     "or NAME=FILE")
        ->type_name("FILE")
        ->required();
    add_view_options(*command, options->view);
    command->add_option("--out", options->out, "the file, such as frame.degsw")
        ->type_name("FILE")
        ->required();
    command->add_flag("--no-reference", options->no_reference,
                      "leave out what reference images are drawn from, so that the file is smaller "
                      "and 'degs run' needs --no-reference, too");
    add_addressed_overrides_option(*command, options->overrides);
    add_memory_option(*command, options->memory);
    command->callback([options] { run_pack(*options); });
}

} // namespace degs::sim
