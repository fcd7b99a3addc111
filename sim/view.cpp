// SPDX-License-Identifier: Apache-2.0
#include "sim/view.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "sim/progress.hpp"
#include "sim/stopwatch.hpp"
#include "sim/words.hpp"
#include "splat/error.hpp"

namespace degs::sim {
namespace {

void check_positive(const char* option, std::optional<int> value) {
    if (value && *value < 1) {
        throw InputError(std::string(option) + " is " + std::to_string(*value) +
                         ", but an image needs at least 1 pixel.");
    }
}

/// `sides` in double, so that no product of two int overflows.
void check_pixels(double width, double height) {
    if (width * height > static_cast<double>(kMostPixels)) {
        throw InputError("An image of " + three_digits(width) + " x " + three_digits(height) +
                         " pixels is too large; at most " + grouped(kMostPixels) +
                         " pixels (8192 x 4320) are allowed.");
    }
}

/// All frames of a path are in memory at once; a typing error should not fill it.
constexpr int kMostFrames = 10000;

struct Resolution {
    const char* name;
    int height; ///< px
};
constexpr std::array<Resolution, 5> kResolutions{
    {{"720p", 720}, {"1080p", 1080}, {"2k", 1440}, {"4k", 2160}, {"8k", 4320}}};

std::string in_small_letters(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

} // namespace

std::vector<std::string> resolution_names() {
    std::vector<std::string> names;
    names.reserve(kResolutions.size());
    for (const Resolution& resolution : kResolutions) {
        names.emplace_back(resolution.name);
    }
    return names;
}

int resolution_height(const std::string& name) {
    std::string allowed;
    for (const Resolution& resolution : kResolutions) {
        if (in_small_letters(name) == resolution.name) {
            return resolution.height;
        }
        allowed += std::string(allowed.empty() ? "" : ", ") + resolution.name;
    }
    throw InputError("The resolution '" + name + "' is not known; allowed are " + allowed +
                     ", and --width and --height for any other size.");
}

CLI::Option* add_resolution_option(CLI::App& command, std::string& resolution) {
    return command.add_option(
        "--resolution", resolution,
        "720p, 1080p, 2k, 4k or 8k: images 720, 1080, 1440, 2160 or 4320 pixels high, as wide as "
        "the camera's aspect ratio makes them");
}

void add_view_options(CLI::App& command, ViewRequest& request) {
    command
        .add_option("--scene", request.scene,
                    "scene file (.ply), or synthetic:NAME[,gaussians=N][,seed=N]")
        ->required();
    command.add_option("--cameras", request.cameras,
                       "cameras.json to use instead of the one beside the scene");
    command.add_option("--camera", request.camera, "position in the list of cameras, from 0");
    CLI::Option* width =
        command.add_option("--width", request.width, "image width in pixels; the view is scaled");
    CLI::Option* height =
        command.add_option("--height", request.height,
                           "image height in pixels; alone it scales the view, with --width it "
                           "crops or extends it");
    add_resolution_option(command, request.resolution)->excludes(width)->excludes(height);
}

void add_path_options(CLI::App& command, PathRequest& request) {
    CLI::Option* frames =
        command
            .add_option("--frames", request.frames,
                        "frames of a camera path that starts at the view; from 2 on, throughput is "
                        "measured, too")
            ->check(CLI::Range(1, kMostFrames))
            ->capture_default_str();
    command
        .add_option("--path-step", request.step_degrees,
                    "degrees by which the camera turns about the middle of the scene from frame to "
                    "frame")
        ->check(CLI::Range(-kMostPathStepDegrees, kMostPathStepDegrees))
        ->needs(frames)
        ->capture_default_str();
}

Camera resize(const Camera& camera, std::optional<int> width, std::optional<int> height) {
    check_positive("--width", width);
    check_positive("--height", height);
    const double aspect = static_cast<double>(camera.width) / camera.height;
    const double new_width = width ? *width : height ? std::round(*height * aspect) : camera.width;
    const double new_height = height ? *height : std::round(new_width / aspect);
    check_pixels(std::max(new_width, 1.0), std::max(new_height, 1.0));
    Camera resized = camera;
    if (width || height) {
        resized = camera.scaled_to_width(std::max(1, static_cast<int>(new_width)));
        resized.height = height.value_or(resized.height);
    }
    return resized;
}

View load_view(const ViewRequest& request) {
    check_positive("--width", request.width);
    check_positive("--height", request.height);
    const std::optional<int> height =
        request.resolution.empty() ? request.height : resolution_height(request.resolution);
    if (request.scene.empty()) {
        throw InputError("The scene has an empty name; a file or synthetic:NAME is needed.");
    }
    const Progress progress("loading " + request.scene);
    const Stopwatch clock;
    View view;
    view.scene = load_scene(request.scene, request.cameras);
    view.camera = resize(select_camera(view.scene, request.camera), request.width, height);
    view.load_s = clock.seconds();
    return view;
}

} // namespace degs::sim
