// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/ply/ply_header.hpp"

namespace degs {

/// The properties of the vertices of a PLY file that describe Gaussians.
struct PlySplatLayout {
    const PlyElement* vertex = nullptr; ///< inside the header
    int sh_degree = 0;
    bool has_filter_3d = false; ///< Mip-Splatting file whose 3D filter is not fused yet
};

/// InputError with one sentence if the file is something else (point cloud, mesh, compressed or
/// dynamic scene), lacks properties (all are named) or has an impossible number of f_rest.
PlySplatLayout find_splat_layout(const std::string& path, const PlyHeader& header);

} // namespace degs
