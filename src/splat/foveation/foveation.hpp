// SPDX-License-Identifier: Apache-2.0
// Foveated frames: full resolution where the eye looks, fewer pixels around.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "splat/model/camera.hpp"

namespace degs {

/// Where the eye looks, and how far from there each resolution reaches.
struct Foveation {
    glm::dvec2 centre{0.5}; ///< shares of the image's width and height, 0 .. 1
    double fovea = 90;      ///< degrees from the centre, in (0, 90]; drawn with every pixel
    double periphery = 90;  ///< degrees, `fovea` .. 90; a quarter of the pixels up to there
};

/// A part of a foveated image and the view that draws it.
struct FoveatedLevel {
    int scale = 1;       ///< px of the image along a side of a pixel of the view: 1, 2 or 4
    PixelBox shown;      ///< of the image, from its upper left corner, minus what finer levels show
    glm::ivec2 first{0}; ///< the view's first pixel among all pixels of its size in the image
    Camera camera;       ///< a window of them; its hole is what `shown` has no use for
};

/// The levels of a camera's image, finest first: one px of the image a pixel in the rectangle that
/// reaches `fovea` from the centre, 2 x 2 px in the one that reaches `periphery`, 4 x 4 px in the
/// others. Half sides of the rectangles are focal length x tan(degrees), rounded outward: exact
/// around the view axis of a pinhole. A level that has nothing to show is left out, so that an
/// image within the fovea has one level, whose camera is `camera`. The camera has no hole.
///
/// A coarse view has all pixels from which compose() interpolates, one more than `shown` covers.
std::vector<FoveatedLevel> levels_of(const Camera& camera, const Foveation& foveation);

} // namespace degs
