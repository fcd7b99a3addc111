// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace own {
constexpr int scene_scene = 1;
} // namespace own
