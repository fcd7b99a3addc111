// SPDX-License-Identifier: Apache-2.0
#include "sim/search/hypervolume.hpp"

#include <algorithm>

namespace degs::sim {
namespace {

constexpr double kNegligible = 1e-12; ///< less than this share of a volume is none

/// The volume of what one point beats.
double box(const Goals& point, const Goals& worst) {
    double volume = 1;
    for (std::size_t g = 0; g < point.size(); ++g) {
        volume *= std::max(0.0, worst[g] - point[g]);
    }
    return volume;
}

std::vector<Goals> front_of(const std::vector<Goals>& points) {
    std::vector<Goals> front;
    for (const std::size_t position : pareto_front(points)) {
        front.push_back(points[position]);
    }
    return front;
}

} // namespace

double hypervolume(const std::vector<Goals>& points, const Goals& worst) {
    const std::vector<Goals> front = front_of(points);
    double volume = 0;
    for (std::size_t p = 0; p < front.size(); ++p) {
        volume += hypervolume_gain(
            {front.begin() + static_cast<std::ptrdiff_t>(p) + 1, front.end()}, front[p], worst);
    }
    return volume;
}

double hypervolume_gain(const std::vector<Goals>& points, const Goals& another,
                        const Goals& worst) {
    const double all = box(another, worst);
    if (all == 0 || points.empty()) {
        return all;
    }
    std::vector<Goals> shared = points; // what both beat
    for (Goals& point : shared) {
        for (std::size_t g = 0; g < point.size(); ++g) {
            point[g] = std::max(point[g], another[g]);
        }
    }
    const double gain = all - hypervolume(shared, worst);
    return gain > kNegligible * all ? gain : 0;
}

} // namespace degs::sim
