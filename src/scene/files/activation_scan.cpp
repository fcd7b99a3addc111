// SPDX-License-Identifier: Apache-2.0
#include "scene/files/activation_scan.hpp"

#include <algorithm>
#include <cmath>

namespace degs {
namespace {

// The largest median of the sizes, as a share of the scene's extent. In trained scenes it is below
// 0.02.
constexpr double kLargestSize = 0.25;
// The logarithm of the median, if no Gaussian is smaller than a unit.
constexpr double kSmallestLogarithm = 0.2;

/// The value below which that share of the values lies.
double quantile(std::vector<double>& values, double share) {
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// The longest side of the box that most means lie in; a few far ones do not count.
double extent_of(const std::vector<glm::dvec3>& means) {
    double extent = 0;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> values;
        for (const glm::dvec3& mean : means) {
            if (std::isfinite(mean[axis])) {
                values.push_back(mean[axis]);
            }
        }
        if (!values.empty()) {
            const double low = quantile(values, 0.05);
            extent = std::max(extent, quantile(values, 0.95) - low);
        }
    }
    return extent;
}

/// "No scale is negative and no opacity outside 0 to 1".
std::string evidence(bool scales, bool opacities) {
    return std::string("No ") + (scales ? "scale is negative" : "") +
           (scales && opacities ? " and no " : "") +
           (opacities ? std::string("opacity") + (scales ? "" : " is") + " outside 0 to 1" : "");
}

} // namespace

bool sizes_fit_scene(const std::vector<glm::dvec3>& means, const std::vector<glm::vec3>& scales) {
    std::vector<double> sizes;
    for (const glm::vec3& scale : scales) {
        const float size = std::max({scale.x, scale.y, scale.z});
        if (std::isfinite(size)) {
            sizes.push_back(size);
        }
    }
    if (sizes.empty()) {
        return true;
    }
    const double size = quantile(sizes, 0.5);
    return std::log(size) > kSmallestLogarithm && size < kLargestSize * extent_of(means);
}

std::string activated_note(ActivationScan scan, const GaussianCloud& cloud) {
    if (cloud.size() < kFewestToJudge) {
        return "";
    }
    if (scan.scales_look_activated() && sizes_fit_scene(cloud.means, cloud.scales)) {
        scan.add_scale(-1);
    }
    const bool scales = scan.scales_look_activated();
    const bool opacities = scan.opacities_look_activated();
    if (!scales && !opacities) {
        return "";
    }
    const bool both = scales && opacities;
    return evidence(scales, opacities) + ", so the file seems to hold " +
           (both     ? "both"
            : scales ? "its scales"
                     : "its opacities") +
           " as they are; they were read as " +
           (both     ? "logarithms and logits"
            : scales ? "logarithms"
                     : "logits") +
           ", as its format says.";
}

std::string activated_note(const GaussianCloud& cloud, bool logits) {
    ActivationScan scan;
    if (!logits) {
        scan.add_opacity(-1);
    }
    for (std::size_t i = 0; i < cloud.size() && scan.opacities_look_activated(); ++i) {
        constexpr float kOfZero = 0.5F, kOfOne = 0.731059F; // the logistic function of 0 and 1
        scan.add_opacity(cloud.opacities[i] < kOfZero || cloud.opacities[i] > kOfOne ? -1 : 0);
    }
    for (std::size_t i = 0; i < cloud.size() && scan.scales_look_activated(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            scan.add_scale(cloud.scales[i][axis] < 1 ? -1 : 0); // of the logarithm
        }
    }
    return activated_note(scan, cloud);
}

std::string taken_as_they_are_note(bool scales, bool opacities) {
    if (!scales && !opacities) {
        return "";
    }
    const bool both = scales && opacities;
    return evidence(scales, opacities) + ", so " +
           (both     ? "both"
            : scales ? "the scales"
                     : "the opacities") +
           " were taken as they are, not as " +
           (both     ? "logarithms and logits"
            : scales ? "logarithms"
                     : "logits") +
           ".";
}

} // namespace degs
