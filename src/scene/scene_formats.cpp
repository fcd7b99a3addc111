// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_formats.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "degs/error.hpp"
#include "scene/files/input_file.hpp"
#include "scene/gltf/gltf.hpp"
#include "scene/gltf/gltf_source.hpp"
#include "scene/npz/npz.hpp"
#include "scene/npz/npz_cameras.hpp"
#include "scene/ply/ply.hpp"
#include "scene/ply/ply_camera.hpp"
#include "scene/sog/sog.hpp"
#include "scene/sog/sog_files.hpp"
#include "scene/sog/streamed_sog.hpp"
#include "scene/splat_file/splat_file.hpp"
#include "scene/spz/spz.hpp"
#include "scene/spz/spz_write.hpp"

namespace degs {
namespace {

bool starts_with(std::string_view head, std::string_view signature) {
    return head.substr(0, signature.size()) == signature;
}

/// A zip archive whose first file is called `one` or ends like it, or `other`.
bool is_zip_of(std::string_view head, std::string_view one, std::string_view other) {
    constexpr std::size_t kNameAt = 30; // of the first local header
    constexpr std::size_t kLengthAt = 26;
    if (!starts_with(head, "PK\x03\x04") || head.size() < kNameAt) {
        return false;
    }
    const auto length = static_cast<unsigned char>(head[kLengthAt]);
    const std::string_view name = head.substr(kNameAt, length);
    const auto ends_with = [name](std::string_view end) {
        return name.size() >= end.size() && name.substr(name.size() - end.size()) == end;
    };
    return ends_with(one) || ends_with(other);
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

/// The JSON texts of unbundled and of streamed SOG scenes begin like a glTF.
SceneJson kind_of_text(std::string_view head, const std::string& path) {
    return is_gltf(head) && !starts_with(head, "glTF") && extension_of(path) != ".gltf"
               ? kind_of_json(path)
               : SceneJson::Gltf;
}

/// What stands where a scene was expected, and would be taken for a damaged one.
void refuse_stand_in(std::string_view head, const std::string& extension, const std::string& path) {
    if (starts_with(head, "version https://git-lfs.github.com/spec/")) {
        fail_file(path,
                  "this is the pointer that Git LFS leaves for a file; 'git lfs pull' fetches "
                  "the file itself.");
    }
    if (extension == ".lcc") {
        fail_file(path, "this is a scene in the LCC format, which is not read; allowed are " +
                            allowed_extensions() + ".");
    }
    const std::size_t first = std::min(head.find_first_not_of(" \t\r\n"), head.size());
    if (starts_with(head.substr(first), "<")) {
        fail_file(path, "this is a page of HTML or XML, and a scene is needed; the download may "
                        "have failed.");
    }
}

/// InputError for a file of no format.
const SceneFormat& format_of(const std::string& path) {
    const std::string head = head_of(path);
    const std::string extension = extension_of(path);
    refuse_stand_in(head, extension, path);
    const std::vector<SceneFormat>& formats = scene_formats();
    auto format = std::find_if(formats.begin(), formats.end(),
                               [&](const SceneFormat& f) { return f.matches(head); });
    const SceneJson kind = kind_of_text(head, path);
    if (kind == SceneJson::Other) {
        fail_file(path, "this is JSON text, but no glTF, which has an 'asset', and no SOG; if it "
                        "was downloaded, it may be an answer of the server.");
    }
    if (kind != SceneJson::Gltf) {
        format = std::find_if(formats.begin(), formats.end(), [kind](const SceneFormat& f) {
            return kind == SceneJson::Sog ? f.read == read_sog : f.read_detail != nullptr;
        });
    }
    if (format == formats.end()) {
        format = std::find_if(formats.begin(), formats.end(),
                              [&](const SceneFormat& f) { return has_extension(f, extension); });
    }
    if (format == formats.end()) {
        fail_file(path, "the extension '" + extension +
                            "' is not that of a scene file; allowed are " + allowed_extensions() +
                            ", or 'synthetic:NAME'.");
    }
    return *format;
}

} // namespace

namespace {

std::vector<std::string> lost_traits(const SceneTraits& traits, const std::string& format) {
    return traits.antialiased ? std::vector<std::string>{"The scene was trained with antialiasing, "
                                                         "which a " +
                                                         format + " file cannot say."}
                              : std::vector<std::string>{};
}

} // namespace

const std::vector<SceneFormat>& scene_formats() {
    static const std::vector<SceneFormat> formats{
        {"PLY",
         {".ply"},
         [](std::string_view head) { return starts_with(head, "ply"); },
         read_ply,
         read_ply_cameras,
         nullptr,
         [](const GaussianCloud& cloud, const std::vector<Camera>&, const SceneTraits& traits,
            const std::string& path) {
             write_ply(cloud, path);
             return lost_traits(traits, "PLY");
         }},
        {"SPZ",
         {".spz"},
         [](std::string_view head) {
             return starts_with(head, "\x1f\x8b") || starts_with(head, "NGSP");
         },
         read_spz,
         nullptr,
         nullptr,
         [](const GaussianCloud& cloud, const std::vector<Camera>&, const SceneTraits& traits,
            const std::string& path) {
             return write_spz(cloud, path, {3, traits.antialiased});
         }},
        {"glTF",
         {".glb", ".gltf"},
         is_gltf,
         read_gltf,
         read_gltf_cameras,
         gltf_external_files,
         [](const GaussianCloud& cloud, const std::vector<Camera>& cameras,
            const SceneTraits& traits, const std::string& path) {
             write_glb(cloud, cameras, {}, path);
             return lost_traits(traits, "glTF");
         }},
        {"SOG",
         {".sog"},
         [](std::string_view head) { return is_zip_of(head, ".webp", "meta.json"); },
         read_sog,
         nullptr,
         sog_external_files},
        {"streamed SOG",
         {},
         [](std::string_view) { return false; },
         [](const std::string& path) { return read_streamed_sog(path, {}); },
         nullptr,
         nullptr,
         nullptr,
         read_streamed_sog,
         streamed_sog_files},
        {"NPZ",
         {".npz"},
         [](std::string_view head) { return is_zip_of(head, ".npy", ".npy"); },
         read_npz,
         read_npz_cameras},
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

bool has_scene_extension(const std::string& path) {
    const std::vector<SceneFormat>& formats = scene_formats();
    return std::any_of(formats.begin(), formats.end(), [&](const SceneFormat& format) {
        return has_extension(format, extension_of(path));
    });
}

namespace {

/// nullptr if no format of the extension is written.
const SceneFormat* writer_of(const std::string& path) {
    const std::string extension = extension_of(path);
    for (const SceneFormat& format : scene_formats()) {
        if (format.write != nullptr && extension == format.extensions.front()) {
            return &format;
        }
    }
    return nullptr;
}

} // namespace

SceneContent read_scene_file(const std::string& path, const SceneDetail& detail) {
    const SceneFormat& format = format_of(path);
    if (!detail.asked()) {
        return format.read(path);
    }
    if (format.read_detail == nullptr) {
        fail_file(path, std::string("this scene has no levels of detail; '?") +
                            (detail.level ? "lod" : "budget") +
                            "=' is for the lod-meta.json of a streamed SOG scene.");
    }
    return format.read_detail(path, detail);
}

std::vector<Camera> read_scene_cameras(const std::string& path) {
    const SceneFormat& format = format_of(path);
    return format.read_cameras == nullptr ? std::vector<Camera>{} : format.read_cameras(path);
}

std::vector<std::string> scene_external_files(const std::string& path, const SceneDetail& detail) {
    try {
        const SceneFormat& format = format_of(path);
        if (format.detail_files != nullptr) {
            return format.detail_files(path, detail);
        }
        return format.external_files == nullptr ? std::vector<std::string>{}
                                                : format.external_files(path);
    } catch (const InputError&) {
        return {}; // reading the scene says what is wrong
    }
}

std::string writable_scene_extensions() {
    std::string list;
    for (const SceneFormat& format : scene_formats()) {
        if (format.write != nullptr) {
            list += (list.empty() ? "" : ", ") + std::string(format.extensions.front());
        }
    }
    return list;
}

void check_scene_writable(const std::string& path) {
    if (writer_of(path) == nullptr) {
        throw InputError("The scene file '" + path +
                         "' cannot be written: its name must end in one of " +
                         writable_scene_extensions() + ".");
    }
}

std::vector<std::string> write_scene_file(const GaussianCloud& cloud,
                                          const std::vector<Camera>& cameras,
                                          const SceneTraits& traits, const std::string& path) {
    check_scene_writable(path);
    return writer_of(path)->write(cloud, cameras, traits, path);
}

} // namespace degs
