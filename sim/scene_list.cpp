// SPDX-License-Identifier: Apache-2.0
#include "sim/scene_list.hpp"

#include <algorithm>
#include <filesystem>

namespace degs::sim {
namespace {

bool exists(const std::string& file) {
    std::error_code ignored;
    return std::filesystem::exists(file, ignored);
}

/// True if the piece is a setting of the synthetic scene before it and not the name of a scene.
bool is_setting(const std::vector<std::string>& scenes, std::size_t own, const std::string& piece) {
    return scenes.size() > own && scenes.back().rfind("synthetic:", 0) == 0 &&
           piece.find('=') != std::string::npos && !exists(piece);
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
