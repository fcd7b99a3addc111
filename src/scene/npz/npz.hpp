// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/files/scene_content.hpp"

namespace degs {

/// Reads a scene in NumPy's .npz archive. Gaussians as gsplat names them: means (N, 3), scales (N,
/// 3), quats (N, 4) as w x y z, opacities (N) or (N, 1), and either sh0 (N, 1, 3) with shN (N, K,
/// 3), or colors (N, K, 3); K makes degree 0 to 4. Scales may be logarithms and opacities logits,
/// as training stores them, or both as they are drawn: negative scales or opacities outside 0 to 1
/// tell. Without scales, points (means, means3d or points (N, 3), with colors or rgb (N, 3)) become
/// Gaussians as the original 3DGS code starts from them. Cameras, in either case: viewmats (C, 4,
/// 4), world to camera, Ks (C, 3, 3), width and height. Other arrays are not read. InputError for
/// anything else.
SceneContent read_npz(const std::string& path);

} // namespace degs
