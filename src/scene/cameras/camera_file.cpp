// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/camera_file.hpp"

#include <cctype>
#include <filesystem>

#include "scene/cameras/camera_formats.hpp"
#include "scene/files/input_file.hpp"

namespace degs {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHead = 64; // bytes that decide

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

enum class Kind { CamerasJson, TransformsJson, Colmap };

/// Counts of COLMAP's binary files are 8 bytes, the upper ones 0; its text files begin with a
/// comment, and the names of others are fixed.
Kind kind_of(const std::string& path) {
    InputFile file(path);
    std::string head(kHead, '\0');
    head.resize(file.read_some(head.data(), head.size()));
    require_utf8(path, head);
    const std::string name = fs::path(path).filename().string();
    if (head.substr(0, 8).find('\0') != std::string::npos || head[0] == '#' ||
        name == "cameras.txt" || name == "images.txt" || name == "cameras.bin" ||
        name == "images.bin") {
        return Kind::Colmap;
    }
    std::size_t begin = head.rfind(kByteOrderMark, 0) == 0 ? kByteOrderMark.size() : 0;
    while (begin < head.size() && std::isspace(static_cast<unsigned char>(head[begin])) != 0) {
        ++begin;
    }
    return begin < head.size() && head[begin] == '{' ? Kind::TransformsJson : Kind::CamerasJson;
}

/// The model that a single file of it belongs to.
ColmapFiles colmap_of_file(const std::string& path) {
    const fs::path file(path);
    const std::string stem = file.stem().string();
    const std::string extension = file.extension().string();
    if ((stem != "cameras" && stem != "images") || (extension != ".bin" && extension != ".txt")) {
        fail_file(path, "this looks like a file of a COLMAP model, and such files are called "
                        "cameras.bin and images.bin, or cameras.txt and images.txt.");
    }
    const fs::path folder = file.parent_path();
    return {(folder / ("cameras" + extension)).string(), (folder / ("images" + extension)).string(),
            extension == ".bin"};
}

/// A camera file in a folder; empty if there is none.
std::string camera_file_in(const fs::path& folder) {
    for (const char* name : {"cameras.json", "transforms.json"}) {
        if (name_exists(folder / name)) {
            return (folder / name).string();
        }
    }
    const fs::path colmap = folder / "sparse" / "0";
    return colmap_in(colmap.string()).cameras.empty() ? "" : colmap.string();
}

} // namespace

bool is_training_output(const std::string& file) {
    const fs::path absolute = absolute_path(file);
    return absolute.stem() == "point_cloud" &&
           absolute.parent_path().filename().string().rfind("iteration_", 0) == 0;
}

CameraFile read_camera_file(const std::string& path) {
    if (is_folder(path)) {
        const ColmapFiles files = colmap_in(path);
        if (files.cameras.empty()) {
            const std::string inside = camera_file_in(path);
            if (inside.empty()) {
                fail_file(path, "this folder holds no cameras; cameras.json, transforms.json, or "
                                "cameras and images of a COLMAP model (.bin or .txt) are needed.");
            }
            return read_camera_file(inside);
        }
        return read_colmap(files);
    }
    switch (kind_of(path)) {
    case Kind::Colmap:
        return read_colmap(colmap_of_file(path));
    case Kind::TransformsJson:
        return read_transforms_json(path);
    default:
        return read_cameras_json(path);
    }
}

std::string own_camera_file(const std::string& scene_file) {
    const fs::path file(scene_file);
    return (file.parent_path() / (file.stem().string() + ".cameras.json")).string();
}

std::string cameras_beside(const std::string& scene_file) {
    const fs::path file(scene_file);
    if (std::string own = own_camera_file(scene_file); name_exists(own)) {
        return own;
    }
    std::string found = camera_file_in(file.parent_path());
    if (found.empty() && is_training_output(scene_file)) {
        found = camera_file_in(absolute_path(file).parent_path().parent_path().parent_path());
    }
    return found;
}

std::vector<std::string> files_of_cameras(const std::string& path) {
    const fs::path file(path);
    if (path.empty() || !name_exists(file)) {
        return {path};
    }
    const ColmapFiles files = colmap_in(is_folder(file) ? path : file.parent_path().string());
    if (is_folder(file)) {
        const std::string inside = files.cameras.empty() ? camera_file_in(file) : "";
        return inside.empty() ? std::vector<std::string>{files.cameras, files.images}
                              : files_of_cameras(inside);
    }
    return {path, files.cameras, files.images};
}

} // namespace degs
