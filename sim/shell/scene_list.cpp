// SPDX-License-Identifier: Apache-2.0
#include "sim/shell/scene_list.hpp"

#include <algorithm>
#include <filesystem>

#include "scene/scene_spec.hpp"

namespace degs::sim {
namespace {

bool exists(const std::string& file) {
    std::error_code ignored;
    return std::filesystem::exists(file, ignored);
}

/// True if the piece is a setting of the scene before it and not the name of a scene.
bool is_setting(const std::vector<std::string>& scenes, std::size_t own, const std::string& piece) {
    const auto takes_settings = [](const std::string& scene) {
        return scene.rfind("synthetic:", 0) == 0 || parse_scene_spec(scene).path != scene;
    };
    return scenes.size() > own && piece.find('=') != std::string::npos &&
           piece.find('?') == std::string::npos && takes_settings(scenes.back()) && !exists(piece);
}

void split(const std::string& word, std::vector<std::string>& scenes) {
    const std::size_t own = scenes.size(); // pieces of other words are not continued
    for (std::size_t begin = 0; begin <= word.size();) {
        const std::size_t end = std::min(word.find(',', begin), word.size());
        const std::string piece = word.substr(begin, end - begin);
        if (is_setting(scenes, own, piece)) {
            scenes.back() += "," + piece;
        } else {
            scenes.push_back(piece);
        }
        begin = end + 1;
    }
}

} // namespace

std::vector<std::string> split_scenes(const std::vector<std::string>& words) {
    std::vector<std::string> scenes;
    for (const std::string& word : words) {
        if (exists(word)) {
            scenes.push_back(word);
        } else {
            split(word, scenes);
        }
    }
    return scenes;
}

} // namespace degs::sim
