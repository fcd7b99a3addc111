// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "splat/frame/sigma_points.hpp"
#include "splat/model/camera.hpp"
#include "splat/model/lens_map.hpp"
#include "splat/model/vector3.hpp"

namespace degs {

/// What a Gaussian's covariance becomes on the screen before the low-pass filter: xx, xy, yy (px^2)
/// and its determinant (px^4), a sum of non-negative terms.
template <class Scalar>
struct ScreenCovariance {
    Scalar a, b, c, det;
};

/// The unscented projection of 3DGUT through a lens, in the arithmetic of `Numbers`: seven sigma
/// points are projected, and mean and covariance are those of the seven. Every camera is one map of
/// directions here, whatever its lens, and no Jacobian is needed.
///
/// A sigma point that is no longer in front of the camera has no projection, and polynomials of
/// lenses grow beyond bounds outside of the image. Two limits take the place of the Jacobian's: a
/// point at or before the near plane moves towards the mean up to it, and a point farther from the
/// view axis than `clamp` times the corner of the raster (or the fold of the lens, if that is
/// nearer) is drawn in to there, on its side of the axis. A Gaussian of which no point lies within
/// is not shown.
template <class Numbers>
class Unscented {
public:
    using Scalar = typename Numbers::Scalar;
    using Vector = Vector3<Scalar>;

    struct Image {
        Slopes<Scalar> mean; ///< px from the principal point
        ScreenCovariance<Scalar> covariance;
    };

    Unscented(const Numbers& n, const Camera& camera, const Lens& lens, const SigmaPoints& sigma,
              double near_plane, double clamp)
        : map_(n, lens), fx_(n(camera.fx)), fy_(n(camera.fy)), near_(n(near_plane)),
          most_slope_(n(lens.slope_at(
              clamp * glm::length(camera.raster_middle() / glm::dvec2(camera.fx, camera.fy))))),
          distance_(n(sigma.distance())), weight_(n(sigma.weight())),
          root_(n(std::sqrt(sigma.weight()))), centre_root_(n(std::sqrt(sigma.centre_weight()))),
          zero_(n(0.0)) {}

    /// `mean` and the standard deviations along the three axes, as vectors, in view coordinates;
    /// the mean lies beyond the near plane. Nothing if the camera does not show the Gaussian.
    std::optional<Image> operator()(const Vector& mean, const std::array<Vector, 3>& axes) const {
        bool shown = false;
        const Slopes<Scalar> middle = pixels(limited(mean, {zero_, zero_, zero_}, shown));
        std::array<Slopes<Scalar>, 6> points = {middle, middle, middle, middle, middle, middle};
        Slopes<Scalar> sum{zero_, zero_};
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Vector step = axes[i / 2] * (i % 2 == 0 ? distance_ : zero_ - distance_);
            const Slopes<Scalar> point = pixels(limited(mean, step, shown));
            points[i] = {point.x - middle.x, point.y - middle.y};
            sum = {sum.x + points[i].x, sum.y + points[i].y};
        }
        if (!shown) {
            return std::nullopt;
        }
        const Slopes<Scalar> offset{weight_ * sum.x, weight_ * sum.y};
        return Image{{middle.x + offset.x, middle.y + offset.y}, covariance(points, offset)};
    }

private:
    Slopes<Scalar> pixels(const Slopes<Scalar>& s) const {
        const Slopes<Scalar> bent = map_(s);
        return {fx_ * bent.x, fy_ * bent.y};
    }

    /// Sets `shown` if the point lies within the limit, NaN included.
    Slopes<Scalar> limited(const Vector& mean, const Vector& step, bool& shown) const {
        Scalar x = mean.x + step.x, y = mean.y + step.y, z = mean.z + step.z;
        if (!(z > near_)) {
            const Scalar part = (mean.z - near_) / (zero_ - step.z); // of the step
            x = mean.x + part * step.x;
            y = mean.y + part * step.y;
            z = near_;
        }
        const Scalar wide = magnitude(x), high = magnitude(y);
        const Scalar larger = wide < high ? high : wide;
        if (larger >
            most_slope_ * z) { // without a quotient, which a near plane at 0 makes infinite
            return drawn_in({x / larger, y / larger});
        }
        const Slopes<Scalar> slopes{x / z, y / z};
        const Scalar square = slopes.x * slopes.x + slopes.y * slopes.y;
        if (square > most_slope_ * most_slope_) {
            return drawn_in(slopes);
        }
        shown = true;
        return slopes;
    }

    Scalar magnitude(const Scalar& x) const { return x < zero_ ? zero_ - x : x; }

    /// The slopes of the limit's length on the same side.
    Slopes<Scalar> drawn_in(const Slopes<Scalar>& s) const {
        const Scalar factor = most_slope_ / root_of(s.x * s.x + s.y * s.y);
        return {s.x * factor, s.y * factor};
    }

    /// Weights go into the points as their roots, so that the determinant is Cauchy-Binet's sum of
    /// squares over the 21 pairs of points.
    ScreenCovariance<Scalar> covariance(const std::array<Slopes<Scalar>, 6>& points,
                                        const Slopes<Scalar>& offset) const {
        const Slopes<Scalar> centre{centre_root_ * (zero_ - offset.x),
                                    centre_root_ * (zero_ - offset.y)};
        std::array<Slopes<Scalar>, 7> all = {centre, centre, centre, centre,
                                             centre, centre, centre};
        for (std::size_t i = 0; i < points.size(); ++i) {
            all[i + 1] = {root_ * (points[i].x - offset.x), root_ * (points[i].y - offset.y)};
        }
        ScreenCovariance<Scalar> sum{zero_, zero_, zero_, zero_};
        for (std::size_t i = 0; i < all.size(); ++i) {
            sum.a = sum.a + all[i].x * all[i].x;
            sum.b = sum.b + all[i].x * all[i].y;
            sum.c = sum.c + all[i].y * all[i].y;
            for (std::size_t j = 0; j < i; ++j) {
                const Scalar area = all[i].x * all[j].y - all[i].y * all[j].x;
                sum.det = sum.det + area * area;
            }
        }
        return sum;
    }

    LensMap<Numbers> map_;
    Scalar fx_, fy_, near_;
    Scalar most_slope_; ///< of sigma points
    Scalar distance_, weight_, root_, centre_root_, zero_;
};

} // namespace degs
