// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/files/scene_content.hpp"

namespace degs {

/// Reads a .splat file (antimatter15/splat): 32 bytes per Gaussian without a header, little-endian:
/// float position x y z, float linear scale x y z, bytes red green blue opacity, and bytes
/// (b - 128) / 128 of the rotation w x y z. Colours do not depend on the direction (SH degree 0).
/// Because nothing in the file tells it apart from other bytes, a file in which half of the
/// Gaussians or more cannot be drawn is refused. InputError for that and for a size that is no
/// multiple of 32.
SceneContent read_splat_file(const std::string& path);

} // namespace degs
