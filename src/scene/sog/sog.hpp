// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/files/scene_content.hpp"

namespace degs {

/// Reads a SOG scene of PlayCanvas, version 1 or 2: a zip archive of meta.json and lossless WebP
/// images, whose pixels are the Gaussians, or the meta.json itself with the images in its folder.
/// Axes are those of PLY, as splat-transform reads them, although the published specification says
/// otherwise. Images may not have more than 16 pixels per byte of these files (and 65,536), nor
/// palettes more than 65,536 entries, so that memory stays below 4,000 times the size of the file.
/// InputError for anything that is not such a file, also for a streamed scene of many levels.
SceneContent read_sog(const std::string& path);

/// How many Gaussians read_sog() would return, from meta.json alone. InputError as there.
std::uint64_t sog_count(const std::string& path);

/// The images of a scene whose meta.json is `path`; none if it is an archive. InputError as
/// read_sog().
std::vector<std::string> sog_external_files(const std::string& path);

} // namespace degs
