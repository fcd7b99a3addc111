// SPDX-License-Identifier: Apache-2.0
// One camera of a camera file.
#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>

#include "splat/camera.hpp"

namespace degs {

/// Throws InputError "<path>: camera <index> <sentence>".
[[noreturn]] void fail_camera(const std::string& path, std::size_t index,
                              const std::string& sentence);

/// The camera that the JSON object `entry` describes; `path` and `index` are for messages. Throws
/// InputError for a key that is missing or has no allowed value.
Camera parse_camera(const std::string& path, std::size_t index, const nlohmann::json& entry);

} // namespace degs
