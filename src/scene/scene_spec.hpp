// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "scene/files/axes.hpp"
#include "scene/files/scene_detail.hpp"

namespace degs {

/// What a user writes to name a scene: "PATH", "PATH?key=value,key=value" or "synthetic:NAME,...".
struct SceneSpec {
    std::string path;           ///< of the file; of synthetic scenes all that was written
    bool synthetic = false;     ///< no file
    std::optional<Axes> axes;   ///< of the file, whatever it says itself
    std::optional<double> time; ///< of a scene that changes, 0..1
    std::optional<int> frames;  ///< per length of a scene that is a function of time
    SceneDetail detail;         ///< of a scene with several levels of detail
};

/// A file whose name is exactly `text` wins over options. InputError that lists what is allowed for
/// an unknown key, a key without a value, one given twice or a value that the key cannot have. A
/// folder without scene files of its own, but with lod-meta.json or else meta.json, stands for that
/// file. Does not look whether the file exists otherwise.
SceneSpec parse_scene_spec(const std::string& text);

} // namespace degs
