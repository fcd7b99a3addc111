// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>

#include "scene/cameras/camera_formats.hpp"
#include "scene/cameras/colmap_files.hpp"
#include "scene/cameras/lens_terms.hpp"
#include "scene/files/input_file.hpp"

namespace degs {

ColmapFiles colmap_in(const std::string& folder) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    for (const char* inside : {"", "sparse/0", "0"}) {
        for (const bool binary : {true, false}) {
            const fs::path home = *inside == '\0' ? fs::path(folder) : fs::path(folder) / inside;
            const fs::path cameras = home / (binary ? "cameras.bin" : "cameras.txt");
            const fs::path images = home / (binary ? "images.bin" : "images.txt");
            if (fs::exists(cameras, ignored) && fs::exists(images, ignored)) {
                return {cameras.string(), images.string(), binary};
            }
        }
    }
    return {};
}

CameraFile read_colmap(const ColmapFiles& files) {
    CameraFile result;
    result.of_original_data = true;
    ColmapCameras cameras = files.binary ? read_colmap_cameras_binary(files.cameras)
                                         : read_colmap_cameras_text(files.cameras);
    cameras.sort(files.cameras);
    result.cameras = files.binary ? read_colmap_images_binary(files.images, cameras)
                                  : read_colmap_images_text(files.images, cameras);
    if (result.cameras.empty()) {
        fail_file(files.images, "the file holds no image; at least one is needed.");
    }
    std::sort(result.cameras.begin(), result.cameras.end(),
              [](const Camera& a, const Camera& b) { return a.name < b.name; });
    for (std::size_t i = 1; i < result.cameras.size(); ++i) {
        if (result.cameras[i - 1].name == result.cameras[i].name) {
            fail_file(files.images,
                      "two images have the name " + in_quotes(result.cameras[i].name) + ".");
        }
    }
    LensNote lenses;
    for (const Camera& camera : result.cameras) {
        lenses.add(camera);
    }
    if (std::string note = lenses.text(files.cameras); !note.empty()) {
        result.notes.push_back(std::move(note));
    }
    return result;
}

} // namespace degs
