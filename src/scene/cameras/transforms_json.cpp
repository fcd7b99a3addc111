// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "base/json_text.hpp"
#include "scene/cameras/camera_formats.hpp"
#include "scene/cameras/json_entries.hpp"
#include "scene/cameras/json_entry.hpp"
#include "scene/cameras/lens_terms.hpp"
#include "scene/files/input_file.hpp"
#include "splat/model/angles.hpp"

namespace degs {
namespace {

constexpr int kAssumedSide = 800; // px; the images of NeRF's synthetic scenes, which name no size
const char* const kTransformsFile =
    "transforms.json is an object with the cameras' intrinsics and an array 'frames'";
const std::vector<const char*> kLensKeys{"w",
                                         "h",
                                         "fl_x",
                                         "fl_y",
                                         "cx",
                                         "cy",
                                         "k1",
                                         "k2",
                                         "k3",
                                         "k4",
                                         "p1",
                                         "p2",
                                         "camera_angle_x",
                                         "camera_angle_y",
                                         "camera_model",
                                         "is_fisheye"};

std::vector<const char*> with_lens_keys(std::vector<const char*> keys) {
    keys.insert(keys.end(), kLensKeys.begin(), kLensKeys.end());
    return keys;
}

const JsonEntries& transforms_root() {
    static const JsonEntries entries{JsonEntries::Where::Root,
                                     "",
                                     kTransformsFile,
                                     "the file",
                                     "frames, and w, h and fl_x or camera_angle_x",
                                     with_lens_keys({"applied_transform", "applied_scale"}),
                                     21}; // an array of 4 arrays of 4 numbers
    return entries;
}

const JsonEntries& transforms_frames() {
    static const JsonEntries entries{JsonEntries::Where::List,
                                     "frames",
                                     kTransformsFile,
                                     "frame",
                                     "transform_matrix",
                                     with_lens_keys({"transform_matrix", "file_path"}),
                                     21};
    return entries;
}

/// Intrinsics as far as they are known; those of a frame override those of the file.
struct Intrinsics {
    std::optional<int> w, h;
    std::optional<double> fl_x, fl_y, cx, cy, angle_x, angle_y;
    bool fisheye = false;
    double k[4] = {0, 0, 0, 0}, p[2] = {0, 0};

    void read(const CameraPlace& place, const JsonEntry& entry);
    void read_lens(const CameraPlace& place, const JsonEntry& entry);
    /// Fills size, focal lengths and lens of the camera.
    void apply(const CameraPlace& place, Camera& camera) const;
};

double angle(const CameraPlace& place, const JsonEntry& entry, const char* key) {
    const double value = entry.number(key);
    if (!(value > 0 && value < kPi)) {
        place.fail("has a " + std::string(key) + " of " + dump_json(entry.at(key)) +
                   "; allowed are angles in radians above 0 and below pi.");
    }
    return value;
}

void Intrinsics::read_lens(const CameraPlace& place, const JsonEntry& entry) {
    if (entry.has("camera_model")) {
        const std::string model = entry.text("camera_model");
        bool known = model == "OPENCV_FISHEYE";
        for (const char* good :
             {"PINHOLE", "SIMPLE_PINHOLE", "OPENCV", "SIMPLE_RADIAL", "RADIAL", "PERSPECTIVE"}) {
            known = known || model == good;
        }
        if (!known) {
            place.fail("has a camera_model " + in_quotes(model) +
                       ", which is not known; allowed are PINHOLE, SIMPLE_PINHOLE, OPENCV, "
                       "SIMPLE_RADIAL, RADIAL, PERSPECTIVE and OPENCV_FISHEYE.");
        }
        fisheye = model == "OPENCV_FISHEYE";
    }
    if (entry.has("is_fisheye")) {
        fisheye = fisheye || entry.at("is_fisheye") == true;
    }
    const std::pair<const char*, double*> terms[] = {{"k1", k},     {"k2", k + 1}, {"k3", k + 2},
                                                     {"k4", k + 3}, {"p1", p},     {"p2", p + 1}};
    for (const auto& [key, value] : terms) {
        *value = entry.has(key) ? entry.number(key) : *value;
    }
}

void Intrinsics::read(const CameraPlace& place, const JsonEntry& entry) {
    read_lens(place, entry);
    for (const auto& [key, side] : {std::pair("w", &w), std::pair("h", &h)}) {
        if (entry.has(key)) {
            *side = entry.side(key);
        }
    }
    for (const auto& [key, focal] : {std::pair("fl_x", &fl_x), std::pair("fl_y", &fl_y)}) {
        if (entry.has(key)) {
            *focal = entry.focal_length(key);
        }
    }
    for (const auto& [key, centre] : {std::pair("cx", &cx), std::pair("cy", &cy)}) {
        if (entry.has(key)) {
            *centre = entry.number(key);
        }
    }
    // The angles of a frame say its focal length, unless it has one.
    if (entry.has("camera_angle_x")) {
        angle_x = angle(place, entry, "camera_angle_x");
        fl_x = entry.has("fl_x") ? fl_x : std::nullopt;
    }
    if (entry.has("camera_angle_y")) {
        angle_y = angle(place, entry, "camera_angle_y");
        fl_y = entry.has("fl_y") ? fl_y : std::nullopt;
    }
}

double focal_of_angle(const CameraPlace& place, const char* key, int side, double angle) {
    const double focal = side / (2 * std::tan(angle / 2));
    return checked_focal_length(place, std::string("(from ") + key + ")", focal,
                                std::to_string(focal));
}

void Intrinsics::apply(const CameraPlace& place, Camera& camera) const {
    const bool by_angle = angle_x && !fl_x;
    if (!by_angle && (!w || !h)) {
        place.fail("has no image size; w and h are needed, in the frame or in the file.");
    }
    if (!angle_x && !fl_x) {
        place.fail("has no focal length; fl_x or camera_angle_x is needed, in the frame or in the "
                   "file.");
    }
    camera.width = w.value_or(kAssumedSide);
    camera.height = h.value_or(kAssumedSide);
    camera.fx = fl_x ? *fl_x : focal_of_angle(place, "camera_angle_x", camera.width, *angle_x);
    camera.fy = fl_y      ? *fl_y
                : angle_y ? focal_of_angle(place, "camera_angle_y", camera.height, *angle_y)
                          : camera.fx; // square pixels
    set_principal_point(place, cx.value_or(camera.width / 2.0), cy.value_or(camera.height / 2.0),
                        camera);
    // Without counterparts: a fisheye has no tangential terms, and k4 is of r^8 otherwise.
    camera.lens = fisheye ? fisheye_lens({k[0], k[1], k[2], k[3]})
                          : open_cv_lens({k[0], k[1], p[0], p[1], k[2], 0, 0, 0, k[3]});
}

/// What was done to the poses of the original data: p_file = applied_scale (applied_transform p).
struct AppliedChange {
    std::optional<glm::dmat4> transform;
    std::optional<double> scale;

    /// Leads from the file's coordinates back to those of the original data.
    glm::dmat4 inverse() const {
        const double s = scale.value_or(1);
        const glm::dmat4 shrunk(1 / s, 0, 0, 0, 0, 1 / s, 0, 0, 0, 0, 1 / s, 0, 0, 0, 0, 1);
        return glm::inverse(transform.value_or(glm::dmat4(1.0))) * shrunk;
    }
    /// A sentence; empty if nothing was done.
    std::string note(const std::string& path) const {
        const std::string what = transform && scale ? "The applied_transform and the applied_scale"
                                 : transform        ? "The applied_transform"
                                                    : "The applied_scale";
        return !transform && !scale ? ""
                                    : what + " of " + path + (transform && scale ? " are" : " is") +
                                          " undone, so that its cameras are in the coordinates of "
                                          "the original data.";
    }
};

/// The pose of a camera-to-world matrix with the axes of OpenGL.
void set_pose(const CameraPlace& place, const glm::dmat4& matrix, const glm::dmat4& to_original,
              Camera& camera) {
    check_rotation(place, "transform_matrix", glm::dmat3(matrix));
    const glm::dmat4 pose = to_original * matrix;
    camera.position = glm::dvec3(pose[3]);
    if (!std::isfinite(camera.position.x + camera.position.y + camera.position.z)) {
        place.fail("has no finite position once what was applied to it is undone.");
    }
    const glm::dvec3 signs(1, -1, -1); // y up, z back: here y down, z forward
    for (int axis = 0; axis < 3; ++axis) {
        camera.camera_to_world[axis] = signs[axis] * glm::normalize(glm::dvec3(pose[axis]));
    }
}

} // namespace

CameraFile read_transforms_json(const std::string& path) {
    Intrinsics common;
    AppliedChange applied;
    read_json_entries(path, transforms_root(), [&](std::size_t, const nlohmann::json& json) {
        const CameraPlace place(path, transforms_root().entry);
        const JsonEntry entry(place, json, transforms_root().needed);
        common.read(place, entry);
        if (entry.has("applied_transform")) {
            applied.transform = entry.similarity("applied_transform");
        }
        if (entry.has("applied_scale")) {
            applied.scale = entry.positive("applied_scale");
        }
    });
    const glm::dmat4 to_original = applied.inverse();
    CameraFile file;
    file.of_original_data = true;
    LensNote lenses;
    bool assumed_size = false;
    read_json_entries(
        path, transforms_frames(), [&](std::size_t index, const nlohmann::json& json) {
            const CameraPlace place(path, entry_name(transforms_frames(), index));
            const JsonEntry entry(place, json, transforms_frames().needed);
            Intrinsics own = common;
            own.read(place, entry);
            Camera camera;
            camera.id = static_cast<int>(index);
            camera.name = entry.has("file_path")
                              ? std::filesystem::path(entry.text("file_path")).stem().string()
                              : place.entry();
            own.apply(place, camera);
            lenses.add(camera);
            assumed_size = assumed_size || !own.w || !own.h;
            set_pose(place, entry.affine("transform_matrix"), to_original, camera);
            file.cameras.push_back(std::move(camera));
        });
    if (assumed_size) {
        file.notes.push_back(path +
                             " has no image size (w, h), and 800 x 800 pixels are assumed, as "
                             "in NeRF's synthetic scenes.");
    }
    if (std::string note = applied.note(path); !note.empty()) {
        file.notes.push_back(std::move(note));
    }
    if (std::string note = lenses.text(path); !note.empty()) {
        file.notes.push_back(std::move(note));
    }
    return file;
}

} // namespace degs
