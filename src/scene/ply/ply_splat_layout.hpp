// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/ply/ply_header.hpp"

namespace degs {

/// The properties of the vertices of a PLY file that describe Gaussians.
struct PlySplatLayout {
    const PlyElement* vertex = nullptr; ///< inside the header
    int sh_degree = 0;                  ///< 0..3, of the cloud
    int rest_coefficients = 0;  ///< per channel in the file, f_rest_*: may be those of degree 4
    int scales = 3;             ///< 2: discs (2D Gaussian Splatting)
    bool rgb = false;           ///< red, green, blue in place of f_dc_*
    bool has_filter_3d = false; ///< Mip-Splatting file whose 3D filter is not fused yet
};

/// Everything guessed or passed over is added to `notes`. InputError with one sentence if the file
/// is something else (point cloud, mesh, dynamic scene), lacks properties (all are named) or has an
/// impossible number of f_rest.
PlySplatLayout find_splat_layout(const std::string& path, const PlyHeader& header,
                                 std::vector<std::string>& notes);

} // namespace degs
