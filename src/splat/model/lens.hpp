// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

namespace degs {

/// The slopes x/z and y/z of a direction, or what a lens makes of them: times the focal lengths
/// they are px from the principal point.
template <class Scalar>
struct Slopes {
    Scalar x, y;
};

/// The coefficients of a lens, as OpenCV publishes its two models; r is the length of the slopes
/// (x, y) and t = atan r the angle to the view axis.
///
/// OpenCv: x (1 + k1 r^2 + k2 r^4 + k3 r^6 + k4' r^8) / (1 + k4 r^2 + k5 r^4 + k6 r^6)
///         + 2 p1 x y + p2 (r^2 + 2 x^2), and y with p1 and p2 exchanged;
/// Fisheye: x / r (t + k1 t^3 + k2 t^5 + k3 t^7 + k4 t^9), and y likewise.
struct LensCoefficients {
    enum class Kind : std::int64_t { Pinhole, OpenCv, Fisheye };

    Kind kind = Kind::Pinhole;
    std::array<double, 4> radial{};      ///< k1, k2, k3 and nerfstudio's k4'; fisheye: k1 to k4
    std::array<double, 3> denominator{}; ///< OpenCV's k4, k5, k6
    std::array<double, 2> tangential{};  ///< p1, p2

    bool operator==(const LensCoefficients& other) const;
    bool operator!=(const LensCoefficients& other) const { return !(*this == other); }
};

/// What a camera's lens does to directions. It bends without folding up to fold_slope(): beyond,
/// polynomials come back, and directions that no real lens shows there would be drawn.
class Lens {
public:
    /// The steepest slope of a lens, 89.94 degrees: a direction beyond is not in front.
    static constexpr double kMostSlope = 1000;

    Lens() = default; ///< a pinhole
    /// Without coefficients, OpenCv is a pinhole. Values that are not finite fold at 0.
    explicit Lens(const LensCoefficients& coefficients);

    const LensCoefficients& coefficients() const { return coefficients_; }
    bool is_pinhole() const { return coefficients_.kind == LensCoefficients::Kind::Pinhole; }
    /// "pinhole", "OpenCV", "OpenCV fisheye".
    const char* name() const;
    /// Finite coefficients, and no others than the kind has.
    bool is_sound() const;

    /// The length of slopes up to which no two directions share a point. OpenCv: where the least
    /// eigenvalue of the map's (symmetric) Jacobian, min(f'(r), f(r)/r) - 6 |p| r at least, stops
    /// being positive, which makes the map one-to-one on that disc. Searched in 4096 steps.
    double fold_slope() const { return fold_slope_; }
    /// The length that slopes of length `slope` get, tangential terms aside.
    double radius_at(double slope) const;
    /// The inverse; fold_slope() if the lens reaches no such radius before.
    double slope_at(double radius) const;
    /// Where a direction lands, in double.
    glm::dvec2 bent(const glm::dvec2& slopes) const;

    bool operator==(const Lens& other) const { return coefficients_ == other.coefficients_; }
    bool operator!=(const Lens& other) const { return !(*this == other); }

private:
    /// Positive as long as the map does not fold.
    double growth_at(double slope) const;

    LensCoefficients coefficients_;
    double fold_slope_ = kMostSlope;
};

} // namespace degs
