// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/cameras/camera_formats.hpp"
#include "scene/cameras/json_entries.hpp"
#include "scene/cameras/json_entry.hpp"

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
         "generated"},
        13}; // a rotation is an array of 3 arrays of 3 numbers
    return entries;
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
    camera.position = entry.vector("position");
    camera.camera_to_world = entry.rows("rotation");
    check_rotation(place, "rotation", camera.camera_to_world);
    return camera;
}

} // namespace

CameraFile read_cameras_json(const std::string& path) {
    CameraFile file;
    read_json_entries(path, json_cameras(), [&](std::size_t index, const nlohmann::json& json) {
        const CameraPlace place(path, entry_name(json_cameras(), index));
        file.cameras.push_back(camera_of_json(place, index, json));
        file.generated =
            file.generated || (json.contains("generated") && json["generated"] == true);
    });
    if (file.generated) {
        file.notes.push_back("The view in " + path +
                             " was generated for a scene that has no cameras.");
    }
    return file;
}

} // namespace degs
