// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/colmap_models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "scene/cameras/lens_terms.hpp"
#include "scene/files/input_file.hpp"

namespace degs {
namespace {

using Family = ColmapModel::Family;

constexpr std::array<ColmapModel, 12> kModels{{
    {0, "SIMPLE_PINHOLE", 3, 1, Family::OpenCv},
    {1, "PINHOLE", 4, 2, Family::OpenCv},
    {2, "SIMPLE_RADIAL", 4, 1, Family::OpenCv},
    {3, "RADIAL", 5, 1, Family::OpenCv},
    {4, "OPENCV", 8, 2, Family::OpenCv},
    {5, "OPENCV_FISHEYE", 8, 2, Family::Fisheye},
    {6, "FULL_OPENCV", 12, 2, Family::OpenCv},
    {7, "FOV", 5, 2, Family::Other},
    {8, "SIMPLE_RADIAL_FISHEYE", 4, 1, Family::Fisheye},
    {9, "RADIAL_FISHEYE", 5, 1, Family::Fisheye},
    {10, "THIN_PRISM_FISHEYE", 12, 2, Family::Other},
    {11, "RAD_TAN_THIN_PRISM_FISHEYE", 16, 2, Family::Other},
}};

const ColmapModel& usable(const CameraPlace& place, const ColmapModel* model,
                          const std::string& text) {
    if (model == nullptr || model->family == Family::Other) {
        place.fail("has the camera model " + text +
                   (model == nullptr ? ", which is not known" : "") +
                   "; allowed are SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, "
                   "FULL_OPENCV, OPENCV_FISHEYE, SIMPLE_RADIAL_FISHEYE and RADIAL_FISHEYE, and "
                   "COLMAP's image_undistorter makes PINHOLE of the others.");
    }
    return *model;
}

std::string number_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

/// Rotation matrix of a unit quaternion w x y z.
glm::dmat3 rotation_of(const double* q) {
    const double w = q[0];
    const double x = q[1];
    const double y = q[2];
    const double z = q[3];
    return glm::transpose(
        glm::dmat3(1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                   2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                   2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)));
}

bool before(const ColmapCamera& a, std::uint32_t id) {
    return a.id < id;
}

} // namespace

const ColmapModel& colmap_model(const CameraPlace& place, std::int64_t number) {
    const bool known = number >= 0 && number < static_cast<std::int64_t>(kModels.size());
    const ColmapModel* model = known ? &kModels[number] : nullptr;
    return usable(place, model, known ? model->name : "number " + std::to_string(number));
}

const ColmapModel& colmap_model(const CameraPlace& place, const std::string& name) {
    const auto found = std::find_if(kModels.begin(), kModels.end(),
                                    [&](const ColmapModel& model) { return name == model.name; });
    return usable(place, found == kModels.end() ? nullptr : &*found, in_quotes(name));
}

ColmapCamera colmap_camera(const CameraPlace& place, std::uint32_t id, const ColmapModel& model,
                           double width, double height, const std::vector<double>& parameters) {
    for (const double value : parameters) {
        if (!std::isfinite(value)) {
            place.fail("has a parameter of its camera model that is not finite.");
        }
    }
    const bool two = model.focal_lengths == 2;
    const int centre = model.focal_lengths;
    ColmapCamera made{id, {}};
    Camera& camera = made.camera;
    camera.width = checked_side(place, "width", width, number_text(width));
    camera.height = checked_side(place, "height", height, number_text(height));
    camera.fx =
        checked_focal_length(place, two ? "fx" : "f", parameters[0], number_text(parameters[0]));
    camera.fy = two ? checked_focal_length(place, "fy", parameters[1], number_text(parameters[1]))
                    : camera.fx;
    set_principal_point(place, parameters[centre], parameters[centre + 1], camera);
    const std::vector<double> terms(parameters.begin() + centre + 2, parameters.end());
    camera.lens = model.family == Family::Fisheye ? fisheye_lens(terms) : open_cv_lens(terms);
    return made;
}

void ColmapCameras::sort(const std::string& path) {
    std::sort(list_.begin(), list_.end(),
              [](const ColmapCamera& a, const ColmapCamera& b) { return a.id < b.id; });
    for (std::size_t i = 1; i < list_.size(); ++i) {
        if (list_[i - 1].id == list_[i].id) {
            fail_file(path, "two cameras have the id " + std::to_string(list_[i].id) + ".");
        }
    }
}

Camera ColmapCameras::view(const CameraPlace& place, std::uint32_t image, std::uint32_t camera,
                           const ColmapPose& pose, std::string name) const {
    if (image > static_cast<std::uint32_t>(std::numeric_limits<int>::max())) {
        place.fail("has the id " + std::to_string(image) + "; allowed are ids below 2147483648.");
    }
    const auto found = std::lower_bound(list_.begin(), list_.end(), camera, before);
    if (found == list_.end() || found->id != camera) {
        place.fail("names the camera " + std::to_string(camera) +
                   ", which the file of cameras does not have.");
    }
    constexpr double kUnit = 1e-3; // largest deviation of the quaternion's length from 1
    const double* const q = pose.rotation;
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(std::abs(length - 1) <= kUnit)) {
        place.fail("has a rotation whose quaternion is not of length 1 within 1e-3.");
    }
    const glm::dvec3 translation(pose.translation[0], pose.translation[1], pose.translation[2]);
    if (!std::isfinite(translation.x + translation.y + translation.z)) {
        place.fail("has a translation that is not finite.");
    }
    double unit[4];
    std::transform(q, q + 4, unit, [length](double value) { return value / length; });
    Camera view = found->camera;
    view.camera_to_world = glm::transpose(rotation_of(unit));
    view.position = -(view.camera_to_world * translation);
    view.id = static_cast<int>(image);
    view.name = std::move(name);
    return view;
}

} // namespace degs
