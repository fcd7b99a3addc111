// SPDX-License-Identifier: Apache-2.0
// Lenses as camera files spell them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/cameras/camera_place.hpp"
#include "splat/model/lens.hpp"

namespace degs {

/// A camera model and its distortion: OPENCV with k1 k2 p1 p2, FULL_OPENCV with these and k3 k4 k5
/// k6 (and the factor of r^8, if a file of nerfstudio has one), or OPENCV_FISHEYE with k1 k2 k3 k4.
struct LensTerms {
    std::string model;
    std::vector<double> terms;
};

/// The terms of a lens that is not a pinhole.
LensTerms terms_of(const Lens& lens);

/// k1 k2 p1 p2 k3 k4 k5 k6 and the factor of r^8, or as many of the first as there are.
Lens open_cv_lens(const std::vector<double>& terms);
/// k1 k2 k3 k4, or as many of the first as there are.
Lens fisheye_lens(const std::vector<double>& terms);

/// The lens that terms_of() describes; none for a kind or a number of terms that it never says.
std::optional<Lens> lens_of(const LensTerms& lens);

/// How far the lens moves the corner of its image that is farthest from the principal point, px; 0
/// without distortion. Not a number where the lens has no value there.
double corner_shift(const Camera& camera);

/// What a file of cameras has of lenses, for its note.
class LensNote {
public:
    /// Counts the lens of a camera whose size and principal point are set.
    void add(const Camera& camera);
    /// A full sentence for lenses that fold before a corner of their image, or else for those that
    /// show next to nothing; empty if there are none.
    std::string text(const std::string& path) const;

private:
    double fold_ = 90;      ///< degrees from the view axis, the least that lies before a corner
    double narrowest_ = 90; ///< degrees from the view axis to a corner, the least that is shown
};

} // namespace degs
