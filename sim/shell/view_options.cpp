// SPDX-License-Identifier: Apache-2.0
#include "sim/shell/view_options.hpp"

#include "degs/error.hpp"

namespace degs::sim {
namespace {

/// Comparisons and sweeps have all frames of a path in memory; a typing error should not fill it.
constexpr int kMostFrames = 10000;

} // namespace

void add_resolution_option(CLI::App& command, std::string& resolution) {
    command
        .add_option(
            "--resolution", resolution,
            "720p, 1080p, 2k, 4k or 8k: images 720, 1080, 1440, 2160 or 4320 pixels high, as wide "
            "as the camera's aspect ratio makes them; or WIDTHxHEIGHT")
        ->type_name("SIZE");
}

CLI::Option* add_config_option(CLI::App& command, std::string& config) {
    return command.add_option("config", config, "configuration file (YAML)")->type_name("FILE");
}

void add_scene_argument(CLI::App& command, std::string& scene) {
    command.add_option("scene", scene, "scene file, or synthetic:NAME[,...]")
        ->type_name("SCENE")
        ->required();
}

CLI::Option* add_camera_file_option(CLI::App& command, std::string& file) {
    return command
        .add_option("--camera-file", file,
                    "cameras.json, transforms.json or a COLMAP model to use instead of the cameras "
                    "beside the scene")
        ->type_name("FILE");
}

CLI::Option* add_crop_option(CLI::App& command, std::string& crop) {
    return command
        .add_option("--crop", crop,
                    "part of the image that is rendered: W x H pixels from column X and row Y on; "
                    "its pixels are those of the whole image")
        ->type_name("X,Y,WxH");
}

void add_memory_option(CLI::App& command, std::string& file) {
    command
        .add_option("--memory", file,
                    "file of an LPDDR5 memory, as in configs/memory; it overrides the memory "
                    "section of every design")
        ->type_name("FILE");
}

CLI::Option* add_out_option(CLI::App& command, std::string& folder, const char* meaning) {
    return command.add_option("--out", folder, meaning)->type_name("FOLDER")->capture_default_str();
}

void add_jobs_option(CLI::App& command, int& jobs) {
    command.add_option("--jobs", jobs, "simulations at a time, each in its own process")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
}

void add_camera_options(CLI::App& command, ViewRequest& request) {
    add_camera_file_option(command, request.camera_file);
    command
        .add_option_function<std::string>(
            "--camera,--cameras",
            [&request](const std::string& text) { request.camera = one_camera(text); },
            "position in the scene's list of cameras, from 0")
        ->type_name("POSITION");
}

void add_size_options(CLI::App& command, ViewRequest& request) {
    command.add_option("--width", request.width, "image width in pixels; the view is scaled");
    command.add_option("--height", request.height,
                       "image height in pixels; alone it scales the view, with --width it crops or "
                       "extends it");
}

void add_view_options(CLI::App& command, ViewRequest& request) {
    command
        .add_option("--scene", request.scene,
                    "scene file, or synthetic:NAME[,gaussians=N][,seed=N]")
        ->type_name("SCENE")
        ->required();
    add_camera_options(command, request);
    add_size_options(command, request);
    add_resolution_option(command, request.resolution);
    add_crop_option(command, request.crop);
}

void add_view_or_workload_options(CLI::App& command, ViewRequest& request) {
    add_view_options(command, request);
    command.get_option("--scene")->required(false);
    command
        .add_option_function<std::string>(
            "--workload",
            [&request](const std::string& file) {
                if (file.empty()) {
                    throw InputError("The workload has an empty name; a file is needed.");
                }
                request.workload = file;
            },
            "frame that 'degs workload pack' has written, instead of a scene and a view")
        ->type_name("FILE");
}

void add_path_options(CLI::App& command, PathRequest& request) {
    command
        .add_option("--frames", request.frames,
                    "frames of a camera path that starts at the view, or of a scene that changes; "
                    "from 3 on, throughput is measured, too")
        ->check(CLI::Range(1, kMostFrames))
        ->capture_default_str();
    command
        .add_option("--path-step", request.step_degrees,
                    "degrees by which the camera turns about the middle of the scene from frame to "
                    "frame")
        ->check(CLI::Range(-kMostPathStepDegrees, kMostPathStepDegrees))
        ->capture_default_str();
}

void add_eyes_option(CLI::App& command, GroupRequest& request) {
    command
        .add_option("--eyes", request.eyes_m,
                    "distance of two eyes, m: each frame has two views, half of it to the left "
                    "and to the right of the camera")
        ->type_name("METRES")
        ->check(CLI::Range(0.0, kMostEyeDistance));
}

void add_group_options(CLI::App& command, GroupRequest& request) {
    add_eyes_option(command, request);
    command.add_option("--units-per-metre", request.units_per_metre, "scene units for a metre")
        ->check(CLI::Range(kLeastUnitsPerMetre, kMostUnitsPerMetre))
        ->capture_default_str();
    command
        .add_option_function<std::string>(
            "--views",
            [&request](const std::string& text) { request.cameras = group_cameras(text); },
            "positions of cameras, separated by commas, that are views of one frame and share "
            "what projection.shared_by_views says")
        ->type_name("POSITIONS");
}

void add_foveation_option(CLI::App& command, GroupRequest& request) {
    command
        .add_option_function<std::string>(
            "--foveation",
            [&request](const std::string& text) { request.foveation = foveation_of(text); },
            "point looked at, in shares of width and height, and degrees from there: full "
            "resolution up to FOVEA, half up to PERIPHERY, a quarter beyond")
        ->type_name("X,Y:FOVEA:PERIPHERY");
}

void add_sampling_options(CLI::App& command, std::optional<std::string>& within,
                          std::uint64_t& seed) {
    command
        .add_option("--within", within,
                    "simulate no more tiles than it takes for a 95 % interval of this half-width: "
                    "1% (of the cycles), or useful:2% (of another measure)")
        ->type_name("ERROR");
    command.add_option("--seed", seed, "of the draw of tiles, with --within or a sampled fidelity")
        ->type_name("UINT")
        ->capture_default_str();
}

} // namespace degs::sim
