// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "scene/gltf/gltf_model.hpp"
#include "splat/model/gaussian.hpp"

namespace degs {

/// A primitive with KHR_gaussian_splatting, or a draft of it.
bool is_splat_primitive(const tinygltf::Primitive& primitive);

struct SplatPrimitive {
    GaussianCloud cloud;
    bool compressed = false;   ///< decoded from SPZ, in the axes of glTF (LUF)
    bool axes_assumed = false; ///< SPZ data that does not say which way its axes point
    bool antialiased = false;  ///< as SPZ says it
};

/// The Gaussians of such a primitive in the axes of its mesh. Attributes are those of the release
/// candidate of KHR_gaussian_splatting (Khronos, text of 2026-04-15) or of the drafts of 2025,
/// which are read with a note. A primitive that is compressed with SPZ (drafts of 2025 and 2026,
/// three names) is read from that data alone. Rotations and ranges are as in the file; sanitize()
/// looks at them. InputError names mesh, primitive and attribute.
SplatPrimitive read_splat_primitive(GltfFile& file, std::size_t mesh, std::size_t primitive);

} // namespace degs
