// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "splat/frame/frame_workload.hpp"

namespace degs {

/// A frame for as long as somebody looks at it.
using FramePointer = std::shared_ptr<const FrameWorkload>;

/// A frame that outlives all who look at it.
inline FramePointer borrowed(const FrameWorkload& frame) {
    return {std::shared_ptr<const FrameWorkload>(), &frame};
}

/// Frames that are made one after the other, each when somebody needs it.
struct FrameSource {
    std::size_t frames = 0;             ///< that are still to come
    std::function<FramePointer()> next; ///< null: there will be none of them after all
    /// The next frame, if there is one; else null.
    FramePointer take() {
        FramePointer frame = frames == 0 ? nullptr : next();
        frames -= frame == nullptr ? frames : 1;
        return frame;
    }
};

/// Frames that are there, and outlive the source.
inline FrameSource source_of(std::vector<const FrameWorkload*> frames) {
    const std::size_t count = frames.size();
    return {count, [frames = std::move(frames), taken = std::size_t{0}]() mutable {
                return borrowed(*frames[taken++]);
            }};
}

} // namespace degs
