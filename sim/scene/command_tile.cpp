// SPDX-License-Identifier: Apache-2.0
// degs scene tile: a large scene of many copies.
#include "sim/scene/command_tile.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "degs/error.hpp"
#include "scene/tiling/scene_tiling.hpp"
#include "sim/scene/scene_out_option.hpp"
#include "sim/scene/scene_output.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

struct TileOptions {
    std::string scene, out;
    std::optional<TilingCounts> copies; ///< else those for a number of Gaussians
    std::uint64_t gaussians = 0;
};

void run_tile(const TileOptions& options) {
    if (std::filesystem::path(options.out).extension() != ".glb") {
        throw InputError("The scene file '" + options.out +
                         "' cannot be written: a tiled scene shows one mesh many times, which only "
                         ".glb can.");
    }
    const Scene scene = load_scene(options.scene);
    const TilingCounts counts =
        options.copies ? *options.copies : tiling_for(options.gaussians, scene.cloud.size());
    const SceneTiling tiling = tile_scene(scene.cloud, counts);
    const std::string words = scene.name + " · " + grouped(counts.copies) + " copies of " +
                              grouped(scene.cloud.size()) +
                              " Gaussians = " + grouped(counts.copies * scene.cloud.size()) + ", " +
                              three_digits(tiling.spacing.x) + " units apart, SH " +
                              std::to_string(scene.cloud.sh_degree);
    write_scene(options.out, words, tiling.cameras,
                [&] { write_glb(scene.cloud, tiling.cameras, tiling.instances, options.out); });
}

} // namespace

void add_scene_tile(CLI::App& scene) {
    auto options = std::make_shared<TileOptions>();
    CLI::App* command = scene.add_subcommand(
        "tile", "write a large scene: copies of one, side by side on the ground");
    add_scene_argument(*command, options->scene);
    command
        ->add_option_function<std::string>(
            "--copies",
            [options](const std::string& text) { options->copies = parse_tiling(text); },
            "copies along x and z, e.g. 4x3, and layers, e.g. 4x3x2")
        ->type_name("NxM[xK]");
    command
        ->add_option("--gaussians", options->gaussians,
                     "as many copies as it takes to have this number, in a square")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40U));
    add_scene_out(*command, options->out, ".glb");
    command->callback([options] { run_tile(*options); });
}

} // namespace degs::sim
