// SPDX-License-Identifier: Apache-2.0
// A second opinion on lenses: OpenCV's published formulas (cv::projectPoints and
// cv::fisheye::projectPoints), written down literally in long double.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "splat/model/camera.hpp"

namespace degs::test {

/// A kind of lens with its coefficients, in the order of OpenCV's vectors.
struct PublishedLens {
    const char* name;
    bool fisheye;
    std::vector<double> d; ///< k1 k2 p1 p2 k3 k4 k5 k6, or k1 k2 k3 k4

    double at(std::size_t i) const { return i < d.size() ? d[i] : 0; }

    /// Slopes in the image of a point in view coordinates.
    std::pair<long double, long double> slopes_of(const glm::dvec3& point) const {
        const long double a = static_cast<long double>(point.x) / point.z;
        const long double b = static_cast<long double>(point.y) / point.z;
        const long double r2 = a * a + b * b;
        if (fisheye) {
            const long double r = std::sqrt(r2);
            const long double t = std::atan2(r, 1.0L);
            const long double td = t + at(0) * std::pow(t, 3) + at(1) * std::pow(t, 5) +
                                   at(2) * std::pow(t, 7) + at(3) * std::pow(t, 9);
            return r == 0 ? std::pair(a, b) : std::pair(td / r * a, td / r * b);
        }
        const long double r4 = r2 * r2, r6 = r4 * r2;
        const long double radial =
            (1 + at(0) * r2 + at(1) * r4 + at(4) * r6) / (1 + at(5) * r2 + at(6) * r4 + at(7) * r6);
        return {a * radial + 2 * at(2) * a * b + at(3) * (r2 + 2 * a * a),
                b * radial + at(2) * (r2 + 2 * b * b) + 2 * at(3) * a * b};
    }

    /// Pixels from the upper left corner of an image with this principal point.
    glm::dvec2 pixel_of(const glm::dvec3& point, const glm::dvec4& focal_and_middle) const {
        const auto [a, b] = slopes_of(point);
        return {static_cast<double>(focal_and_middle[0] * a + focal_and_middle[2]),
                static_cast<double>(focal_and_middle[1] * b + focal_and_middle[3])};
    }

    Lens lens() const {
        LensCoefficients c;
        c.kind = fisheye ? LensCoefficients::Kind::Fisheye : LensCoefficients::Kind::OpenCv;
        if (fisheye) {
            c.radial = {at(0), at(1), at(2), at(3)};
        } else {
            c.radial = {at(0), at(1), at(4), 0};
            c.tangential = {at(2), at(3)};
            c.denominator = {at(5), at(6), at(7)};
        }
        return Lens(c);
    }
};

/// Lenses as calibrations have them, one of each model that files may name.
inline const std::vector<PublishedLens>& published_lenses() {
    static const std::vector<PublishedLens> lenses{
        {"simple_radial", false, {-0.08}},
        {"radial", false, {-0.28, 0.07}},
        {"opencv", false, {-0.2, 0.05, 0.002, -0.001}},
        {"pincushion", false, {0.12, 0.03}},
        {"full_opencv", false, {0.9, 0.3, 0.0007, -0.0004, 0.02, 1.2, 0.5, 0.06}},
        {"equidistant", true, {}},
        {"simple_radial_fisheye", true, {0.03}},
        {"radial_fisheye", true, {-0.02, 0.004}},
        {"opencv_fisheye", true, {-0.013, 0.02, -0.012, 0.0025}}};
    return lenses;
}

} // namespace degs::test
