// SPDX-License-Identifier: Apache-2.0
// The two spellings of a COLMAP model's files.
#pragma once

#include <string>
#include <vector>

#include "scene/cameras/colmap_models.hpp"

namespace degs {

constexpr std::size_t kMostImageName = 4096; ///< bytes of an image's name, as long as a path may be

/// cameras.bin: a count (8 bytes), and for each camera its id (4), model (4), width and height (8
/// each) and the model's parameters (8 each). Sizes must use up the file. Throws InputError.
ColmapCameras read_colmap_cameras_binary(const std::string& path);

/// images.bin: a count, and for each image its id (4), quaternion (32), translation (24), camera
/// (4), name (ends with a zero byte), and a count (8) of 2D points (24 each), which are skipped.
/// Sizes must use up the file. Throws InputError.
std::vector<Camera> read_colmap_images_binary(const std::string& path,
                                              const ColmapCameras& cameras);

/// cameras.txt: lines of CAMERA_ID MODEL WIDTH HEIGHT PARAMETERS. Lines that begin with # are
/// comments.
ColmapCameras read_colmap_cameras_text(const std::string& path);

/// images.txt: two lines for each image, IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, and its 2D
/// points in threes, which are counted and skipped; the line may be empty.
std::vector<Camera> read_colmap_images_text(const std::string& path, const ColmapCameras& cameras);

} // namespace degs
