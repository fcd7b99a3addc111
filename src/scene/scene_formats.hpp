// SPDX-License-Identifier: Apache-2.0
// Which file formats hold scenes, and who reads them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/files/scene_content.hpp"
#include "scene/files/scene_detail.hpp"

namespace degs {

struct SceneFormat {
    const char* name;                       ///< short, for messages, e.g. "PLY"
    std::vector<const char*> extensions;    ///< lower case with the dot, e.g. ".ply"
    bool (*matches)(std::string_view head); ///< do the first kHeadBytes of a file look like it?
    SceneContent (*read)(const std::string& path);
    /// The cameras in the file, without its Gaussians; nullptr: the format has none.
    std::vector<Camera> (*read_cameras)(const std::string& path) = nullptr;
    /// Files that `read` reads in addition; nullptr: none.
    std::vector<std::string> (*external_files)(const std::string& path) = nullptr;
    /// Writes a file of the format's first extension and returns a sentence for everything that it
    /// cannot hold; nullptr: such files are not written.
    std::vector<std::string> (*write)(const GaussianCloud& cloud,
                                      const std::vector<Camera>& cameras, const SceneTraits& traits,
                                      const std::string& path) = nullptr;
    /// `read` and `external_files` with the levels of detail that were asked for; nullptr: the
    /// format has no levels.
    SceneContent (*read_detail)(const std::string& path, const SceneDetail& detail) = nullptr;
    std::vector<std::string> (*detail_files)(const std::string& path,
                                             const SceneDetail& detail) = nullptr;
};

/// Bytes of a file that decide about its format (fewer if the file is shorter).
constexpr std::size_t kHeadBytes = 64;

const std::vector<SceneFormat>& scene_formats();

/// File name extensions of all formats, e.g. ".ply".
std::vector<std::string> scene_extensions();

/// Whether the name of a file ends in one of scene_extensions(), in either case.
bool has_scene_extension(const std::string& path);

/// Reads a scene file. Its first bytes choose the format, because files are renamed; formats
/// without a signature are known by the extension. InputError for a file of no format, and for a
/// detail of a scene that has no levels.
SceneContent read_scene_file(const std::string& path, const SceneDetail& detail = {});

/// The cameras that read_scene_file() would return, at less cost. InputError as there.
std::vector<Camera> read_scene_cameras(const std::string& path);

/// Files that read_scene_file() reads in addition to `path`; none if it would fail.
std::vector<std::string> scene_external_files(const std::string& path,
                                              const SceneDetail& detail = {});

/// ".ply, .glb" and so on: the files that write_scene_file() writes.
std::string writable_scene_extensions();

/// InputError unless write_scene_file() writes files of this name.
void check_scene_writable(const std::string& path);

/// Writes a cloud in the axes of PLY; the extension chooses the format. Cameras and traits go into
/// the file if the format has any. Returns a sentence for everything that the file cannot hold.
/// InputError if no format of the extension is written, or the place cannot be.
std::vector<std::string> write_scene_file(const GaussianCloud& cloud,
                                          const std::vector<Camera>& cameras,
                                          const SceneTraits& traits, const std::string& path);

} // namespace degs
