// SPDX-License-Identifier: Apache-2.0
// Just enough of a pixel page for pictures whose pixels matter: images, rectangles and plain text.
#pragma once

#include <array>
#include <string>

#include "splat/images/image.hpp"

namespace degs::sim {

using Colour = std::array<double, 3>; ///< red, green, blue from 0 to 1, display-referred

/// A white page. Coordinates in px from the top left; what lies beyond the page is cut off.
class Raster {
public:
    Raster(int width, int height);

    void rectangle(int x, int y, int width, int height, const Colour& colour);
    /// The image with its top left corner at (x, y).
    void put(const Image& image, int x, int y);
    /// Text with its top left corner at (x, y); "?" for characters that ASCII has no form of. A
    /// line is kRasterText * scale px high.
    void text(int x, int y, int scale, const std::string& words, const Colour& colour);

    const Image& image() const { return image_; }

private:
    Image image_;
};

constexpr int kRasterText = 12; ///< px, a line of text at scale 1

/// Width of the text in px.
int raster_width(const std::string& words, int scale);

} // namespace degs::sim
