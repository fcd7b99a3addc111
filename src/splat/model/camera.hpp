// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <glm/glm.hpp>

#include "splat/model/lens.hpp"
#include "splat/model/pixel_box.hpp"

namespace degs {

/// The longest side of a raster, px.
constexpr int kMostRasterSide = 1 << 20;

/// A camera in the convention of the original 3DGS code, a pinhole unless it has a lens. The view
/// axes are x right, y down and z forward, and a pixel is sampled at its centre.
///
/// The image is a window of a raster whose middle is the principal point. Whatever is projected,
/// listed and drawn has coordinates of the raster, so that a window shows what the whole raster
/// shows there, to the last bit; the image's own coordinates begin at `origin`. A camera with the
/// principal point in the middle of its image has a raster of the size of the image.
struct Camera {
    int id = 0;
    std::string name;
    int width = 0;                   ///< pixels
    int height = 0;                  ///< pixels
    double fx = 0;                   ///< focal length, pixels of `width`
    double fy = 0;                   ///< focal length, pixels of `height`
    Lens lens;                       ///< of slopes, so that it is the same at every size
    glm::dvec2 shift{0.0};           ///< of the principal point from the image's middle, px
    glm::ivec2 origin{0};            ///< the image's first pixel in the raster, >= 0
    PixelBox hole;                   ///< of the raster, shown by another view; see TileGrid
    glm::dvec3 position{0.0};        ///< camera centre in world space
    glm::dmat3 camera_to_world{1.0}; ///< columns are the view axes in world space

    /// View z of a point in front of the camera that projects into the image, edges included; none
    /// of any other point.
    std::optional<double> seen_depth(const glm::dvec3& point) const;
    /// Where a point lands in the raster, px from its upper left corner, in double; none if it is
    /// not in front of the camera, or beyond the fold of the lens.
    std::optional<glm::dvec2> landing_of(const glm::dvec3& point) const;
    std::uint64_t pixels() const { return std::uint64_t{1} * width * height; }

    /// In the raster, px from its upper left corner: half the raster's sides.
    glm::dvec2 raster_middle() const {
        return glm::dvec2(origin) + 0.5 * glm::dvec2(width, height) + shift;
    }
    /// In the image, px from its upper left corner: `cx` and `cy` of most files.
    glm::dvec2 principal_point() const { return 0.5 * glm::dvec2(width, height) + shift; }
    /// True if the image is the whole raster.
    bool is_centred() const { return shift == glm::dvec2(0.0) && origin == glm::ivec2(0); }
    /// The image in the raster.
    PixelBox window() const {
        return {origin.x, origin.y, origin.x + width - 1, origin.y + height - 1};
    }
    /// All pixels of the raster, whose last column and row may be partial.
    PixelBox raster() const;
    /// The place in the image, row by row, of a pixel of the raster.
    std::uint64_t place_of(int x, int y) const {
        return std::uint64_t{1} * (y - origin.y) * width + (x - origin.x);
    }

    /// Puts the principal point `point` px from the upper left corner of the image, in the smallest
    /// raster that holds the image. False, and nothing happens, if a side of the raster would be
    /// longer than kMostRasterSide.
    bool set_principal_point(const glm::dvec2& point);
    /// True if the image lies in its raster, and no side of that exceeds kMostRasterSide.
    bool has_sound_raster() const;
    /// The view in a part of this image, which lies inside it.
    Camera cropped(const PixelBox& part) const;
    /// This view at another width; height, focal lengths, principal point and origin follow. The
    /// height is rounded (at least 1), the origin down. Throws InputError if either side leaves
    /// 1 .. 65536.
    Camera scaled_to_width(int new_width) const;
    /// This view with pixels of `factor` x `factor` of these, the first ones at the image's upper
    /// left corner; the last column and row may reach beyond the image. `factor` >= 1.
    Camera coarsened(int factor) const;
};

} // namespace degs
