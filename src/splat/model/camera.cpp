// SPDX-License-Identifier: Apache-2.0
#include "splat/model/camera.hpp"

#include <algorithm>
#include <cmath>

#include "base/ratio.hpp"
#include "degs/error.hpp"

namespace degs {
namespace {

constexpr int kMaxSide = 65536; // px, as in cameras.json

/// The least origin of an image in its raster: twice its shift to the right, rounded down, so that
/// a shift of less than half a pixel adds no column of tiles. The raster's last column is partial
/// if the shift is.
glm::dvec2 least_origin(const glm::dvec2& shift) {
    return glm::max(glm::dvec2(0.0), glm::floor(-2.0 * shift));
}

/// Both coordinates of a pixel on the image's border or within.
bool lies_in(double seen, double z, double focal, double before, double side) {
    return -before / focal * z <= seen && seen <= (side - before) / focal * z;
}

} // namespace

std::optional<glm::dvec2> Camera::landing_of(const glm::dvec3& point) const {
    const glm::dvec3 seen = glm::transpose(camera_to_world) * (point - position);
    if (!(seen.z > 0)) {
        return std::nullopt;
    }
    const glm::dvec2 slopes(seen.x / seen.z, seen.y / seen.z);
    if (!lens.is_pinhole() && !(glm::length(slopes) <= lens.fold_slope())) {
        return std::nullopt;
    }
    return raster_middle() + glm::dvec2(fx, fy) * lens.bent(slopes);
}

std::optional<double> Camera::seen_depth(const glm::dvec3& point) const {
    const glm::dvec3 seen = glm::transpose(camera_to_world) * (point - position);
    if (!lens.is_pinhole()) {
        const std::optional<glm::dvec2> landing = landing_of(point);
        const glm::dvec2 at = landing.value_or(glm::dvec2(-1.0)) - glm::dvec2(origin);
        const bool there = landing && at.x >= 0 && at.x <= width && at.y >= 0 && at.y <= height;
        return there ? std::optional<double>(seen.z) : std::nullopt;
    }
    const glm::dvec2 middle = principal_point();
    const bool inside = seen.z > 0 && lies_in(seen.x, seen.z, fx, middle.x, width) &&
                        lies_in(seen.y, seen.z, fy, middle.y, height);
    return inside ? std::optional<double>(seen.z) : std::nullopt;
}

PixelBox Camera::raster() const {
    const glm::dvec2 sides = glm::ceil(2.0 * raster_middle());
    const PixelBox image = window();
    return {0, 0, std::max(static_cast<int>(sides.x) - 1, image.x1),
            std::max(static_cast<int>(sides.y) - 1, image.y1)};
}

bool Camera::set_principal_point(const glm::dvec2& point) {
    const glm::dvec2 off = point - 0.5 * glm::dvec2(width, height);
    const glm::dvec2 sides = glm::dvec2(width, height) + 2.0 * glm::abs(off);
    // Phrased so that NaN fails.
    if (!(sides.x <= kMostRasterSide && sides.y <= kMostRasterSide)) {
        return false;
    }
    shift = off;
    origin = glm::ivec2(least_origin(off));
    return true;
}

bool Camera::has_sound_raster() const {
    const glm::dvec2 middle = raster_middle();
    const glm::dvec2 least = least_origin(shift);
    // Phrased so that NaN fails; the middle of a cropped view is rounded.
    return middle.x > 0 && 2.0 * middle.x <= kMostRasterSide && middle.y > 0 &&
           2.0 * middle.y <= kMostRasterSide && origin.x >= least.x && origin.y >= least.y &&
           origin.x <= kMostRasterSide && origin.y <= kMostRasterSide;
}

Camera Camera::cropped(const PixelBox& part) const {
    Camera crop = *this;
    crop.width = part.width();
    crop.height = part.height();
    crop.origin = origin + glm::ivec2(part.x0, part.y0);
    crop.shift =
        raster_middle() - glm::dvec2(crop.origin) - 0.5 * glm::dvec2(crop.width, crop.height);
    return crop;
}

Camera Camera::scaled_to_width(int new_width) const {
    const double factor = ratio_of(new_width, width);
    const double new_height = std::max(1.0, std::round(height * factor));
    // Phrased so that a camera without pixels (factor infinite or NaN) fails too.
    if (!(new_width >= 1 && new_width <= kMaxSide && width >= 1 && height >= 1 &&
          new_height <= kMaxSide)) {
        throw InputError("Camera " + std::to_string(id) + " of " + std::to_string(width) + " x " +
                         std::to_string(height) + " pixels cannot be scaled to a width of " +
                         std::to_string(new_width) + "; width and height must lie in 1 .. " +
                         std::to_string(kMaxSide) + " pixels.");
    }
    Camera scaled = *this;
    scaled.hole = {};
    scaled.width = new_width;
    scaled.height = static_cast<int>(new_height);
    scaled.fx = fx * factor;
    scaled.fy = fy * factor;
    scaled.shift = shift * factor;
    scaled.origin =
        glm::ivec2(glm::max(least_origin(scaled.shift), glm::floor(glm::dvec2(origin) * factor)));
    return scaled;
}

// The raster follows as closely as whole pixels allow, because limits of the projection depend on
// it.
Camera Camera::coarsened(int factor) const {
    const double scale = 1.0 / factor;
    Camera coarse = *this;
    coarse.hole = {};
    coarse.width = (width + factor - 1) / factor;
    coarse.height = (height + factor - 1) / factor;
    coarse.fx = fx * scale;
    coarse.fy = fy * scale;
    coarse.shift = principal_point() * scale - 0.5 * glm::dvec2(coarse.width, coarse.height);
    coarse.origin =
        glm::ivec2(glm::max(least_origin(coarse.shift), glm::floor(glm::dvec2(origin) * scale)));
    return coarse;
}

} // namespace degs
