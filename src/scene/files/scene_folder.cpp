// SPDX-License-Identifier: Apache-2.0
#include "scene/files/scene_folder.hpp"

#include <algorithm>
#include <filesystem>

#include "scene/files/input_file.hpp"

namespace degs {
namespace {

namespace fs = std::filesystem;

/// Links are followed first, so that one that leads out of the folder does not help.
bool is_inside(const fs::path& folder, const fs::path& file) {
    const fs::path relative = file.lexically_relative(folder);
    return !relative.empty() && *relative.begin() != "..";
}

} // namespace

bool has_control_characters(const std::string& name) {
    constexpr unsigned char kDelete = 0x7f;
    return std::any_of(name.begin(), name.end(),
                       [](unsigned char c) { return c < ' ' || c == kDelete; });
}

std::string file_in_scene_folder(const std::string& scene, const std::string& name,
                                 const std::string& which) {
    if (has_control_characters(name)) {
        fail_file(scene, which + ", a name with a control character, which is not allowed.");
    }
    std::error_code error;
    const fs::path folder = fs::canonical(absolute_path(scene).parent_path(), error);
    const fs::path file = fs::weakly_canonical(folder / name, error);
    if (error || fs::path(name).is_absolute() || !is_inside(folder, file)) {
        fail_file(scene, which + "; only files in the folder of the scene are read.");
    }
    if (!fs::is_regular_file(file, error)) {
        fail_file(scene, which + ", and there is no such file.");
    }
    return file.string();
}

} // namespace degs
