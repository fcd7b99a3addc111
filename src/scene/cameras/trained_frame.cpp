// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/trained_frame.hpp"

#include <cmath>
#include <filesystem>

#include "scene/cameras/json_entries.hpp"
#include "scene/cameras/json_entry.hpp"
#include "scene/files/input_file.hpp"

namespace degs {
namespace {

const JsonEntries& frame_entries() {
    static const JsonEntries entries{
        JsonEntries::Where::Root,
        "",
        "dataparser_transforms.json is an object with a matrix 'transform' and a number 'scale'",
        "the file",
        "transform and scale",
        {"transform", "scale"},
        21}; // an array of 4 arrays of 4 numbers
    return entries;
}

glm::dmat4 read_trained_frame(const std::string& path) {
    glm::dmat4 moved(1.0);
    read_json_entries(path, frame_entries(), [&](std::size_t, const nlohmann::json& json) {
        const CameraPlace place(path, frame_entries().entry);
        const JsonEntry entry(place, json, frame_entries().needed);
        const double scale = entry.positive("scale");
        moved = entry.similarity("transform");
        for (int column = 0; column < 4; ++column) {
            moved[column] = glm::dvec4(scale * glm::dvec3(moved[column]), moved[column][3]);
        }
    });
    return moved;
}

} // namespace

std::string trained_frame_beside(const std::string& scene_file) {
    const std::filesystem::path file =
        std::filesystem::path(scene_file).parent_path() / "dataparser_transforms.json";
    return name_exists(file) ? file.string() : "";
}

void move_into_trained_frame(const std::string& path, CameraFile& file) {
    if (path.empty() || !file.of_original_data) {
        return;
    }
    const glm::dmat4 moved = read_trained_frame(path);
    for (Camera& camera : file.cameras) {
        camera.position = glm::dvec3(moved * glm::dvec4(camera.position, 1.0));
        if (!std::isfinite(camera.position.x + camera.position.y + camera.position.z)) {
            fail_file(path, "it moves camera " + std::to_string(camera.id) +
                                " to a position that is not finite.");
        }
        for (int axis = 0; axis < 3; ++axis) {
            camera.camera_to_world[axis] =
                glm::normalize(glm::dmat3(moved) * camera.camera_to_world[axis]);
        }
    }
    file.of_original_data = false;
    file.notes.push_back("The cameras are moved by " + path +
                         " into the coordinates in which the scene was trained.");
}

} // namespace degs
