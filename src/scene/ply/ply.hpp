// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/files/scene_content.hpp"

namespace degs {

/// Reads a trained scene in the PLY layout of the original 3DGS code: ASCII or binary of either
/// endianness, any scalar types, properties by name in any order, SH degree 0..4 by the number of
/// f_rest properties (degree 4 is dropped), everything else skipped; also the compressed PLY of
/// PlayCanvas. Applies the activations (exp, sigmoid) and, if the file has a Mip-Splatting
/// `filter_3D`, fuses it into scale and opacity. Two scales are discs, colours may be red, green
/// and blue. Rotations stay as they are and nothing is dropped; `sanitize` does both. InputError
/// for anything that is not such a file.
SceneContent read_ply(const std::string& path);

/// Writes the layout that `read_ply` and other 3DGS tools read: binary, little-endian, all float.
/// Means are rounded to float; scale and opacity return within float rounding of log and exp, 0 and
/// 1 exactly (as finite values, since many readers do not survive an infinite logit).
void write_ply(const GaussianCloud& cloud, const std::string& path);

} // namespace degs
