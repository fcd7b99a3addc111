// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "splat/frame/frame_workload.hpp"
#include "splat/model/camera.hpp"
#include "splat/model/gaussian.hpp"

namespace degs {

/// A generated scene that breaks renderers, seen through one viewport.
struct HardScene {
    GaussianCloud cloud; ///< as a file would have it: not sanitized
    Camera camera;
    ProjectionOptions projection;
    std::vector<PixelBox> windows; ///< where to look, clipped to the image
    SanitizeReport dropped;        ///< what `sanitize` must find
    CullCounts culled;             ///< what the projection must find
    bool same_counts = false; ///< exact spans in fp32 and fp64 update every pixel as often as the
                              ///< reference does
};

/// One entry of the list of hard cases.
struct HardCase {
    std::string id;   ///< "H1" ...
    std::string what; ///< for tables
    std::string expectation;
    /// The scenes for a viewport of width x height px; nullptr if there is nothing to draw.
    std::vector<HardScene> (*make)(int width, int height) = nullptr;
    /// Checks a scene and its workload further. Returns a sentence if a condition fails, else
    /// nothing.
    std::string (*check)(const HardScene& scene, const FrameWorkload& workload) = nullptr;
    /// For cases about files: writes broken files to the folder. Returns a sentence if one of them
    /// is not refused with a clear message, or a right one is misread, else nothing.
    std::string (*refuse)(const std::string& folder) = nullptr;
    bool spans = false; ///< compare the spans of fp32 with those of fp64
};

/// H1 .. H32, in order. Scenes are the same on every platform.
const std::vector<HardCase>& hard_cases();

} // namespace degs
