// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/ply/ply_header.hpp"
#include "splat/model/gaussian.hpp"

namespace degs {

/// Does the header describe the compressed PLY of PlayCanvas: packed vertices, and chunks of 256 of
/// them that hold the ranges of their values?
bool is_compressed_ply(const PlyHeader& header);

/// Decodes such a file as playcanvas/splat-transform does. Positions and log scales have 11, 10 and
/// 11 bits between the bounds of their chunk, rotations 10 bits for each of the three smaller
/// components, colours and opacities 8 bits, f_rest 8 bits between -4 and 4. InputError if an
/// element or property is missing, or shorter than the vertices need.
GaussianCloud read_compressed_ply(InputFile& file, const PlyHeader& header);

} // namespace degs
