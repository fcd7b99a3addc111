// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/archive/zip_archive.hpp"
#include "splat/model/camera.hpp"

namespace degs {

/// The cameras of an .npz archive: viewmats (C, 4, 4) and Ks (C, 3, 3) as gsplat takes them, width
/// and height as numbers. None if it has no viewmats. InputError for arrays of another shape, for
/// values no camera can have, and for a viewmat that is no rotation and translation.
std::vector<Camera> read_npz_cameras(const ZipArchive& archive);

/// The cameras of an .npz file, of which nothing else is read.
std::vector<Camera> read_npz_cameras(const std::string& path);

} // namespace degs
