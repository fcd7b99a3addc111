// SPDX-License-Identifier: Apache-2.0
// The scene, the camera and the image size, for all commands with a scene.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/cameras/camera_path.hpp"
#include "scene/scene.hpp"
#include "splat/foveation/foveation.hpp"

namespace degs::sim {

/// The size of an image, px. A side that is not given follows from the other and the camera's
/// aspect ratio; without both it is the camera's own.
struct ImageSize {
    std::optional<int> width, height;
};

struct ViewRequest {
    std::string scene;
    std::string camera_file; ///< empty: the scene's own
    int camera = 0;
    std::optional<int> width, height;
    std::string resolution; ///< what image_size() reads, empty: width and height decide
    std::string crop;       ///< see crop_of(); empty: all of the view
    std::string workload;   ///< a workload file instead of all of the above; empty: none
};

/// The position in a list of cameras that `text` says, or nothing if it says none.
std::optional<int> camera_position(const std::string& text);
/// At least two positions in a list of cameras, separated by commas. Throws InputError.
std::vector<int> group_cameras(const std::string& text);
/// "0,1": what group_cameras() reads.
std::string positions_words(const std::vector<int>& positions);
/// The camera position in the option of a command that renders one view. Throws InputError.
int one_camera(const std::string& text);

struct View {
    Scene scene;
    Camera camera;
    double load_s = 0;
};

/// 8K as cinemas have it, so that cameras a little wider than 16:9 can be scaled to 8k, too;
/// images, the reference and their comparison take some 100 B per pixel.
constexpr std::int64_t kMostPixels = std::int64_t{8192} * 4320;

/// "720p", "1080p", "2k", "4k", "8k".
std::vector<std::string> resolution_names();
/// Image height in pixels: 720, 1080, 1440, 2160, 4320. Capital letters are allowed; InputError
/// lists the names for any other.
int resolution_height(const std::string& name);
/// What a name of resolution_names() or "WIDTHxHEIGHT" says, as in "2064x2208". Throws InputError
/// for anything else.
ImageSize image_size(const std::string& text);

constexpr double kMostEyeDistance = 1000; ///< m
constexpr double kLeastUnitsPerMetre = 1e-6, kMostUnitsPerMetre = 1e6;

/// Several views of each frame: the eyes of a head, cameras of the scene, or the levels of a
/// foveated image.
struct GroupRequest {
    std::optional<double> eyes_m;       ///< distance of two eyes, m
    double units_per_metre = 1;         ///< scene units
    std::vector<int> cameras;           ///< positions in the scene's list; empty: none
    std::optional<Foveation> foveation; ///< of each image

    /// Images of a frame; each is one view, or has one for each of its levels.
    int images() const {
        return eyes_m ? 2 : cameras.empty() ? 1 : static_cast<int>(cameras.size());
    }
};

/// A run of several frames along a camera path that starts at the view's camera.
struct PathRequest {
    int frames = 1;
    double step_degrees = kPathStepDegrees;
    double near_plane = ProjectionOptions().near_plane; ///< scene units, see path_pivot()
    GroupRequest group{};
};

/// Throws InputError, which names the option, for a number of pixels below 1.
void check_positive(const char* option, std::optional<int> value);

/// The pixels that "X,Y,WxH" names: W columns from X on, H rows from Y on, from the upper left
/// corner. Throws InputError for anything else, and for less than a pixel.
PixelBox crop_of(const std::string& text);

/// What "X,Y:FOVEA:PERIPHERY" asks for: a point of the image in shares of its sides, and two angles
/// from there in degrees. Throws InputError for anything else.
Foveation foveation_of(const std::string& text);

/// Loads the scene, resizes the camera and crops it. Throws InputError.
View load_view(const ViewRequest& request);
/// What can be refused before the scene is loaded. Throws InputError.
void check_view(const ViewRequest& request);
/// The camera of the view in its size, cropped; the scene needs no Gaussians. Throws InputError.
Camera camera_of(const ViewRequest& request, const Scene& scene);

/// The camera in the size that resize() gives it, cropped unless `crop` is empty. Throws
/// InputError.
Camera resize_and_crop(const Camera& camera, std::optional<int> width, std::optional<int> height,
                       const std::string& crop);

/// Width alone or height alone scales the view; both give the image that size at the scale of the
/// width, so that another aspect ratio shows more or less above and below. Throws InputError.
Camera resize(const Camera& camera, std::optional<int> width, std::optional<int> height);

} // namespace degs::sim
