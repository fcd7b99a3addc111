// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/gltf/gltf_nodes.hpp"
#include "splat/model/camera.hpp"

namespace degs {

/// The perspective cameras of the nodes, in their order, numbered from 0. A glTF camera has fields
/// of view and no size: images have 720 rows and round(720 * aspectRatio) columns (16 : 9 without
/// one), unless the extras of the camera hold `width` and `height`, as write_glb() writes them. The
/// fields of view are kept exactly. Orthographic cameras are noted. InputError for a field of view
/// or an aspect ratio outside its range.
std::vector<Camera> gltf_cameras(GltfFile& file, const std::vector<PlacedNode>& nodes);

} // namespace degs
