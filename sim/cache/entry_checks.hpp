// SPDX-License-Identifier: Apache-2.0
// What the entries of a cache must satisfy before a run relies on them: they are files like any
// other.
#pragma once

#include "sim/cache/frame_cache.hpp"

namespace degs::sim {

/// A scene whose facts and cameras a reader of scenes could have found.
bool is_sound(const SceneCard& card);

/// Lists, counts and splats that fit each other and the camera of the frame, as
/// make_frame_workload() leaves them; every number is finite and in its range.
bool is_sound(const FrameWorkload& frame);

/// An image of the size of the frame's camera, whose pixels a renderer could have drawn.
bool is_sound(const Reference& reference, const FrameWorkload& frame);

} // namespace degs::sim
