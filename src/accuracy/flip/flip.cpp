// SPDX-License-Identifier: Apache-2.0
#include "accuracy/flip/flip.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "accuracy/flip/flip_colour.hpp"
#include "accuracy/flip/flip_filter.hpp"
#include "base/ratio.hpp"
#include "splat/images/image_metrics.hpp"

namespace degs {
namespace {

// Constants of the publication: exponents of colour and feature differences, and how large colour
// differences are squeezed: those below kKnee of the largest fill 0 .. kKneeValue.
constexpr double kColourExponent = 0.7;
constexpr double kFeatureExponent = 0.5;
constexpr double kKnee = 0.4;
constexpr double kKneeValue = 0.95;

/// The largest difference of colours that the measure knows: pure green and pure blue.
double largest_difference() {
    const double distance = hyab_distance(hunt_lab_of_linear(glm::dvec3(0, 1, 0)),
                                          hunt_lab_of_linear(glm::dvec3(0, 0, 1)));
    return std::pow(distance, kColourExponent);
}

double colour_difference(const glm::dvec3& ycxcz, const glm::dvec3& other, double largest) {
    const auto seen = [](const glm::dvec3& colour) {
        return hunt_lab_of_linear(glm::clamp(linear_of_ycxcz(colour), 0.0, 1.0));
    };
    const double difference = std::pow(hyab_distance(seen(ycxcz), seen(other)), kColourExponent);
    const double knee = kKnee * largest;
    return difference < knee
               ? difference * kKneeValue / knee
               : kKneeValue + (difference - knee) / (largest - knee) * (1 - kKneeValue);
}

double feature_difference(const FlipRow& row, const FlipRow& other, std::size_t x) {
    const double edge = row.edge[x];
    const double point = row.point[x];
    const double edges = std::abs(edge - other.edge[x]);
    const double points = std::abs(point - other.point[x]);
    return std::pow(std::max(edges, points) / std::sqrt(2.0), kFeatureExponent);
}

} // namespace

std::vector<double> flip_map(const Image& reference, const Image& test, double pixels_per_degree) {
    check_comparable(reference, test);
    const FlipKernels kernels(pixels_per_degree);
    FlipFilter first(reference, kernels);
    FlipFilter second(test, kernels);
    const double largest = largest_difference();
    std::vector<double> differences;
    differences.reserve(reference.pixels());
    const std::size_t width = reference.width;
    for (int y = 0; y < reference.height; ++y) {
        const FlipRow& a = first.next();
        const FlipRow& b = second.next();
        for (std::size_t x = 0; x < width; ++x) {
            const double colour =
                colour_difference({a.y[x], a.cx[x], a.cz[x]}, {b.y[x], b.cx[x], b.cz[x]}, largest);
            differences.push_back(std::pow(colour, 1 - std::min(feature_difference(a, b, x), 1.0)));
        }
    }
    return differences;
}

double flip_difference(const Image& reference, const Image& test, double pixels_per_degree) {
    const std::vector<double> map = flip_map(reference, test, pixels_per_degree);
    return mean_of(std::accumulate(map.begin(), map.end(), 0.0), map.size());
}

} // namespace degs
