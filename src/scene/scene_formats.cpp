// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_formats.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "scene/input_file.hpp"
#include "scene/ply/ply.hpp"
#include "scene/splat_file/splat_file.hpp"
#include "scene/spz/spz.hpp"

namespace degs {
namespace {

bool starts_with(std::string_view head, std::string_view signature) {
    return head.substr(0, signature.size()) == signature;
}

std::string extension_of(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::string allowed_extensions() {
    std::string list;
    for (const std::string& extension : scene_extensions()) {
        list += (list.empty() ? "" : ", ") + extension;
    }
    return list;
}

bool has_extension(const SceneFormat& format, const std::string& extension) {
    return std::find(format.extensions.begin(), format.extensions.end(), extension) !=
           format.extensions.end();
}

std::string head_of(const std::string& path) {
    InputFile file(path);
    std::string head(kHeadBytes, '\0');
    head.resize(file.read_some(head.data(), head.size()));
    return head;
}

} // namespace

const std::vector<SceneFormat>& scene_formats() {
    static const std::vector<SceneFormat> formats{
        {"PLY", {".ply"}, [](std::string_view head) { return starts_with(head, "ply"); }, read_ply},
        {"SPZ",
         {".spz"},
         [](std::string_view head) {
             return starts_with(head, "\x1f\x8b") || starts_with(head, "NGSP");
         },
         read_spz},
        {".splat", {".splat"}, [](std::string_view) { return false; }, read_splat_file},
    };
    return formats;
}

std::vector<std::string> scene_extensions() {
    std::vector<std::string> extensions;
    for (const SceneFormat& format : scene_formats()) {
        extensions.insert(extensions.end(), format.extensions.begin(), format.extensions.end());
    }
    return extensions;
}

SceneContent read_scene_file(const std::string& path) {
    const std::string head = head_of(path);
    const std::string extension = extension_of(path);
    const std::vector<SceneFormat>& formats = scene_formats();
    auto format = std::find_if(formats.begin(), formats.end(),
                               [&](const SceneFormat& f) { return f.matches(head); });
    if (format == formats.end()) {
        format = std::find_if(formats.begin(), formats.end(),
                              [&](const SceneFormat& f) { return has_extension(f, extension); });
    }
    if (format == formats.end()) {
        fail_file(path, "the extension '" + extension +
                            "' is not that of a scene file; allowed are " + allowed_extensions() +
                            ", or 'synthetic:NAME'.");
    }
    return format->read(path);
}

} // namespace degs
