// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/files/scene_content.hpp"
#include "scene/ply/ply_header.hpp"

namespace degs {

/// Reads what SHARP writes beside its Gaussians, each element a column of numbers of its own name,
/// and adds it to cameras and notes: the view of the photograph in `intrinsic` (the 9 of K, px),
/// `extrinsic` (the 16 of world-to-camera, row by row) and `image_size` (width and height, px), and
/// `color_space` (0 sRGB, 1 linear). Its older files have fx, fy, width and height in `intrinsic`,
/// and 12 numbers in `extrinsic`, the rotation column by column. Elements of another length are
/// noted and passed over. InputError for numbers that are no camera. The file is left anywhere in
/// its data.
void read_ply_metadata(InputFile& file, const PlyHeader& header, SceneContent& content);

/// The cameras that read_ply() would find. InputError as there.
std::vector<Camera> read_ply_cameras(const std::string& path);

} // namespace degs
