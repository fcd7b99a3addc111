// SPDX-License-Identifier: Apache-2.0
// Cameras and images of a COLMAP model, as its binary and its text files have them alike.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/cameras/camera_place.hpp"

namespace degs {

/// A camera model of COLMAP (src/colmap/sensor/models.h).
struct ColmapModel {
    int number = 0;
    const char* name = "";
    int parameters = 0;
    int focal_lengths = 1; ///< 1: one for both axes
    enum class Family { OpenCv, Fisheye, Other } family = Family::OpenCv;
};

/// Throws InputError for a model that is unknown or has no lens of OpenCV.
const ColmapModel& colmap_model(const CameraPlace& place, std::int64_t number);
const ColmapModel& colmap_model(const CameraPlace& place, const std::string& name);

/// Size, focal lengths and lens of a camera; its pose is that of its images.
struct ColmapCamera {
    std::uint32_t id = 0;
    Camera camera;
};

/// Checks. `width` and `height` are px, `parameters` has as many as the model takes.
ColmapCamera colmap_camera(const CameraPlace& place, std::uint32_t id, const ColmapModel& model,
                           double width, double height, const std::vector<double>& parameters);

/// World to camera, as the files have it.
struct ColmapPose {
    double rotation[4] = {1, 0, 0, 0}; ///< quaternion w x y z
    double translation[3] = {0, 0, 0};
};

/// All cameras of the model, to be looked up by their images.
class ColmapCameras {
public:
    void add(const ColmapCamera& camera) { list_.push_back(camera); }
    /// After the last one. Throws InputError for an id that is there twice.
    void sort(const std::string& path);
    /// The view of an image. Throws InputError for a camera that the model does not have, and for a
    /// pose that is not one.
    Camera view(const CameraPlace& place, std::uint32_t image, std::uint32_t camera,
                const ColmapPose& pose, std::string name) const;

private:
    std::vector<ColmapCamera> list_; ///< by id once they are sorted
};

} // namespace degs
