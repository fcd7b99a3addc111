// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/files/scene_content.hpp"
#include "scene/files/scene_detail.hpp"

namespace degs {

/// Reads a streamed SOG scene of PlayCanvas: `path` is its lod-meta.json, the parts are SOG scenes
/// (meta.json or, beyond the published format, .sog archives) in its folder or below it. Of each
/// leaf of the tree one level is taken (see choose_sog_levels()), in the order of the files; the
/// environment, if there is one, comes last. Only files that are needed are opened. No Gaussian is
/// taken twice, so that memory stays below what read_sog() needs for all files together, and three
/// times the Gaussians. InputError for anything that is not such a scene.
SceneContent read_streamed_sog(const std::string& path, const SceneDetail& detail);

/// Every file that read_streamed_sog() opens in addition to `path`. InputError if one is missing.
std::vector<std::string> streamed_sog_files(const std::string& path, const SceneDetail& detail);

} // namespace degs
