// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/cameras/camera_formats.hpp"
#include "scene/cameras/json_entries.hpp"
#include "scene/cameras/json_entry.hpp"
#include "scene/cameras/lens_terms.hpp"
#include "scene/files/input_file.hpp"

namespace degs {
namespace {

const JsonEntries& json_cameras() {
    static const JsonEntries entries{
        JsonEntries::Where::Array,
        "",
        "a camera file is a JSON array of cameras, an object with frames, or a COLMAP model",
        "camera",
        "width, height, position, rotation, fx and fy",
        {"id", "img_name", "width", "height", "fx", "fy", "position", "rotation", "cx", "cy",
         "generated", "camera_model", "distortion"},
        13}; // a rotation is an array of 3 arrays of 3 numbers
    return entries;
}

Lens lens_of_json(const CameraPlace& place, const JsonEntry& entry) {
    const std::string model = entry.has("camera_model") ? entry.text("camera_model") : "PINHOLE";
    if (model == "PINHOLE") {
        return {};
    }
    const LensTerms terms{model, entry.numbers("distortion")};
    const std::optional<Lens> lens = lens_of(terms);
    if (!lens) {
        place.fail("has a camera_model " + in_quotes(model) + " with a distortion of " +
                   std::to_string(terms.terms.size()) +
                   " numbers; allowed are PINHOLE, OPENCV (k1 k2 p1 p2), FULL_OPENCV (and k3 k4 k5 "
                   "k6, and a ninth for r^8) and OPENCV_FISHEYE (k1 k2 k3 k4).");
    }
    return *lens;
}

Camera camera_of_json(const CameraPlace& place, std::size_t index, const nlohmann::json& json) {
    constexpr int kMostInt = std::numeric_limits<int>::max();
    const JsonEntry entry(place, json, json_cameras().needed);
    Camera camera;
    camera.id =
        entry.has("id") ? entry.integer("id", -kMostInt, kMostInt) : static_cast<int>(index);
    camera.name = entry.has("img_name") ? entry.text("img_name") : place.entry();
    camera.width = entry.side("width");
    camera.height = entry.side("height");
    camera.fx = entry.focal_length("fx");
    camera.fy = entry.focal_length("fy");
    set_principal_point(place, entry.has("cx") ? entry.number("cx") : camera.width / 2.0,
                        entry.has("cy") ? entry.number("cy") : camera.height / 2.0, camera);
    camera.lens = lens_of_json(place, entry);
    camera.position = entry.vector("position");
    camera.camera_to_world = entry.rows("rotation");
    check_rotation(place, "rotation", camera.camera_to_world);
    return camera;
}

} // namespace

CameraFile read_cameras_json(const std::string& path) {
    CameraFile file;
    LensNote lenses;
    read_json_entries(path, json_cameras(), [&](std::size_t index, const nlohmann::json& json) {
        const CameraPlace place(path, entry_name(json_cameras(), index));
        file.cameras.push_back(camera_of_json(place, index, json));
        lenses.add(file.cameras.back());
        file.generated =
            file.generated || (json.contains("generated") && json["generated"] == true);
    });
    if (file.generated) {
        file.notes.push_back("The view in " + path +
                             " was generated for a scene that has no cameras.");
    }
    if (std::string note = lenses.text(path); !note.empty()) {
        file.notes.push_back(std::move(note));
    }
    return file;
}

} // namespace degs
