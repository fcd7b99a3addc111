// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/lens_terms.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "splat/model/angles.hpp"

namespace degs {
namespace {

constexpr double kWorthANote = 0.01; // px

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

void LensNote::add(const Camera& camera) {
    if (camera.lens.is_pinhole()) {
        return;
    }
    const glm::dvec2 focal(camera.fx, camera.fy);
    const glm::dvec2 point = camera.principal_point();
    const glm::dvec2 corner =
        glm::max(glm::abs(point), glm::abs(glm::dvec2(camera.width, camera.height) - point)) /
        focal;
    const double moved = glm::length(focal * (camera.lens.bent(corner) - corner));
    distortion_ = std::isnan(moved) ? moved : std::max(distortion_, moved);
    const double fold = camera.lens.fold_slope();
    if (fold < Lens::kMostSlope && camera.lens.radius_at(fold) < glm::length(corner)) {
        fold_ = std::min(fold_, std::atan(fold) / kDegree);
    }
}

std::string LensNote::text(const std::string& path) const {
    // Phrased so that a distortion that is not a number is mentioned, too.
    const std::string bends = distortion_ < kWorthANote
                                  ? ""
                                  : "The cameras of " + path + " have lens distortion of up to " +
                                        three_digits(distortion_) + " px in the corners.";
    return fold_ == 90 ? bends
                       : bends + (bends.empty() ? "" : " ") + "A lens of " + path + " folds back " +
                             three_digits(fold_) +
                             " degrees from the view axis, before a corner of its image; nothing "
                             "is drawn beyond.";
}

} // namespace degs
