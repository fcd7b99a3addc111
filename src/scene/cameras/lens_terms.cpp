// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/lens_terms.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "splat/model/angles.hpp"

namespace degs {
namespace {

std::string three_digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

} // namespace

LensTerms terms_of(const Lens& lens) {
    const LensCoefficients& c = lens.coefficients();
    if (c.kind == LensCoefficients::Kind::Fisheye) {
        return {"OPENCV_FISHEYE", {c.radial.begin(), c.radial.end()}};
    }
    std::vector<double> terms{c.radial[0],      c.radial[1],      c.tangential[0],
                              c.tangential[1],  c.radial[2],      c.denominator[0],
                              c.denominator[1], c.denominator[2], c.radial[3]};
    constexpr std::size_t kShort = 4, kFull = 8;
    const auto behind = [&](std::size_t first) {
        return std::any_of(terms.begin() + static_cast<std::ptrdiff_t>(first), terms.end(),
                           [](double term) { return term != 0; });
    };
    terms.resize(behind(kFull) ? terms.size() : behind(kShort) ? kFull : kShort);
    return {terms.size() == kShort ? "OPENCV" : "FULL_OPENCV", std::move(terms)};
}

Lens open_cv_lens(const std::vector<double>& terms) {
    LensCoefficients c;
    c.kind = LensCoefficients::Kind::OpenCv;
    double* const places[] = {&c.radial[0],      &c.radial[1],      &c.tangential[0],
                              &c.tangential[1],  &c.radial[2],      &c.denominator[0],
                              &c.denominator[1], &c.denominator[2], &c.radial[3]};
    for (std::size_t i = 0; i < terms.size(); ++i) {
        *places[i] = terms[i];
    }
    return Lens(c);
}

Lens fisheye_lens(const std::vector<double>& terms) {
    LensCoefficients c;
    c.kind = LensCoefficients::Kind::Fisheye;
    std::copy(terms.begin(), terms.end(), c.radial.begin());
    return Lens(c);
}

std::optional<Lens> lens_of(const LensTerms& lens) {
    const std::size_t count = lens.terms.size();
    if (lens.model == "OPENCV_FISHEYE" && count == 4) {
        return fisheye_lens(lens.terms);
    }
    const bool full = lens.model == "FULL_OPENCV" && (count == 8 || count == 9);
    if (full || (lens.model == "OPENCV" && count == 4)) {
        return open_cv_lens(lens.terms);
    }
    return {};
}

namespace {

glm::dvec2 focal_of(const Camera& camera) {
    return {camera.fx, camera.fy};
}

/// Slopes of the corner that is farthest from the principal point.
glm::dvec2 farthest_corner(const Camera& camera) {
    const glm::dvec2 point = camera.principal_point();
    return glm::max(glm::abs(point), glm::abs(glm::dvec2(camera.width, camera.height) - point)) /
           focal_of(camera);
}

} // namespace

double corner_shift(const Camera& camera) {
    if (camera.lens.is_pinhole()) {
        return 0;
    }
    const glm::dvec2 corner = farthest_corner(camera);
    return glm::length(focal_of(camera) * (camera.lens.bent(corner) - corner));
}

void LensNote::add(const Camera& camera) {
    const double fold = camera.lens.fold_slope();
    if (!camera.lens.is_pinhole() && fold < Lens::kMostSlope &&
        camera.lens.radius_at(fold) < glm::length(farthest_corner(camera))) {
        fold_ = std::min(fold_, std::atan(fold) / kDegree);
    }
    constexpr double kNarrow = 0.1; // no lens that images are made for shows so little
    const double corner = glm::length(farthest_corner(camera));
    const double seen = std::atan(camera.lens.slope_at(corner)) / kDegree;
    if (!camera.lens.is_pinhole() && camera.lens.radius_at(fold) >= corner &&
        seen < kNarrow * std::atan(corner) / kDegree) {
        narrowest_ = std::min(narrowest_, seen);
    }
}

std::string LensNote::text(const std::string& path) const {
    if (fold_ < 90) {
        return "A lens of " + path + " folds back " + three_digits(fold_) +
               " degrees from the view axis, before a corner of its image; nothing is drawn "
               "beyond.";
    }
    if (narrowest_ < 90) {
        return "A lens of " + path + " shows " + three_digits(narrowest_) +
               " degrees from the view axis to the corner of its image, less than a tenth of what "
               "a pinhole shows there; its coefficients may be in other units.";
    }
    return "";
}

} // namespace degs
