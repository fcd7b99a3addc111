// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/dynamic/spacetime.hpp"

namespace degs {

/// Whether the file is a PLY file of SpacetimeGaussians: its vertices have trbf_center. InputError
/// for a PLY file with a broken header.
bool is_spacetime_ply(const std::string& path);

/// Reads a file of the lite model: x y z trbf_center trbf_scale motion_0..8 f_dc_0..2 opacity
/// scale_0..2 rot_0..3 omega_0..3, found by name. InputError for the full model, whose colours come
/// from a neural network, and for everything that read_ply() refuses, too.
SpacetimeCloud read_spacetime_ply(const std::string& path);

/// Writes such a file, binary little-endian, in the original's order of properties.
void write_spacetime_ply(const SpacetimeCloud& scene, const std::string& path);

} // namespace degs
