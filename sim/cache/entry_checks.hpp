// SPDX-License-Identifier: Apache-2.0
// What the entries of a cache must satisfy before a run relies on them: they are files like any
// other.
#pragma once

#include "sim/cache/frame_cache.hpp"
#include "sim/view/frame_checks.hpp"
#include "sim/view/reference.hpp"

namespace degs::sim {

/// A scene whose facts and cameras a reader of scenes could have found.
bool is_sound(const SceneCard& card);

/// An image of the size of the frame's camera, whose pixels a renderer could have drawn.
bool is_sound(const Reference& reference, const FrameWorkload& frame);

} // namespace degs::sim
