// SPDX-License-Identifier: Apache-2.0
// Camera files for tests, written byte by byte.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/cameras/camera_file.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs::test {

inline std::vector<Camera> read_cameras_of(const std::string& path) {
    return read_camera_file(path).cameras;
}

/// Bytes of a value as the machine has them (little-endian).
template <class Value>
std::string bytes_of_value(Value value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
}

struct ColmapImage {
    std::uint32_t id = 1, camera = 1;
    double rotation[4] = {1, 0, 0, 0}; ///< w x y z, world to camera
    double translation[3] = {0, 0, 0};
    std::string name = "a.jpg";
    std::uint64_t points = 0;
};

struct ColmapLens {
    std::uint32_t id = 1;
    std::int32_t model = 1;
    std::uint64_t width = 64, height = 48;
    std::vector<double> parameters{50.5, 51, 32, 24};
};

inline std::string colmap_cameras(const std::vector<ColmapLens>& list) {
    std::string bytes = bytes_of_value(std::uint64_t{list.size()});
    for (const ColmapLens& lens : list) {
        bytes += bytes_of_value(lens.id) + bytes_of_value(lens.model) + bytes_of_value(lens.width) +
                 bytes_of_value(lens.height);
        for (const double value : lens.parameters) {
            bytes += bytes_of_value(value);
        }
    }
    return bytes;
}

inline std::string colmap_images(const std::vector<ColmapImage>& list) {
    std::string bytes = bytes_of_value(std::uint64_t{list.size()});
    for (const ColmapImage& image : list) {
        bytes += bytes_of_value(image.id);
        for (const double value : image.rotation) {
            bytes += bytes_of_value(value);
        }
        for (const double value : image.translation) {
            bytes += bytes_of_value(value);
        }
        bytes += bytes_of_value(image.camera) + image.name + '\0' + bytes_of_value(image.points);
        bytes += std::string(image.points * 24, '\x5a');
    }
    return bytes;
}

} // namespace degs::test
