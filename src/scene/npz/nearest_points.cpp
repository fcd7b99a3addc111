// SPDX-License-Identifier: Apache-2.0
#include "scene/npz/nearest_points.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>

#include "base/parallel.hpp"

namespace degs {
namespace {

constexpr std::size_t kLeafPoints = 16;
constexpr double kNone = std::numeric_limits<double>::infinity();

/// The smallest three of the squared distances that were offered.
struct Nearest {
    std::array<double, 3> squared{kNone, kNone, kNone};

    void offer(double value) {
        for (double& held : squared) {
            if (value < held) {
                std::swap(value, held);
            }
        }
    }
    double worst() const { return squared[2]; }
    double mean() const {
        double sum = 0;
        int found = 0;
        for (const double each : squared) {
            sum += each < kNone ? each : 0;
            found += each < kNone ? 1 : 0;
        }
        return found == 0 ? 0 : sum / found;
    }
};

/// A balanced k-d tree in an array of indices: the middle of each range splits it at its own
/// coordinate on the axis of the widest extent.
class PointTree {
public:
    explicit PointTree(const std::vector<glm::dvec3>& points)
        : points_(points), order_(points.size()), axes_(points.size(), 0) {
        std::iota(order_.begin(), order_.end(), 0U);
        build(0, order_.size());
    }

    double mean_squared(std::uint32_t point) const {
        Nearest nearest;
        search(0, order_.size(), point, nearest);
        return nearest.mean();
    }

private:
    int widest(std::size_t begin, std::size_t end) const {
        glm::dvec3 low(kNone), high(-kNone);
        for (std::size_t i = begin; i < end; ++i) {
            low = glm::min(low, points_[order_[i]]);
            high = glm::max(high, points_[order_[i]]);
        }
        const glm::dvec3 extent = high - low;
        const int xy = extent.x >= extent.y ? 0 : 1;
        return extent[xy] >= extent.z ? xy : 2;
    }

    void build(std::size_t begin, std::size_t end) {
        if (end - begin <= kLeafPoints) {
            return;
        }
        const std::size_t middle = begin + (end - begin) / 2;
        const int axis = widest(begin, end);
        std::nth_element(
            order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
            [&](std::uint32_t a, std::uint32_t b) { return points_[a][axis] < points_[b][axis]; });
        axes_[middle] = static_cast<unsigned char>(axis);
        build(begin, middle);
        build(middle + 1, end);
    }

    void offer(std::uint32_t other, std::uint32_t point, Nearest& nearest) const {
        if (other != point) {
            const glm::dvec3 apart = points_[other] - points_[point];
            nearest.offer(glm::dot(apart, apart));
        }
    }

    void search(std::size_t begin, std::size_t end, std::uint32_t point, Nearest& nearest) const {
        if (end - begin <= kLeafPoints) {
            for (std::size_t i = begin; i < end; ++i) {
                offer(order_[i], point, nearest);
            }
            return;
        }
        const std::size_t middle = begin + (end - begin) / 2;
        const int axis = axes_[middle];
        const double apart = points_[point][axis] - points_[order_[middle]][axis];
        offer(order_[middle], point, nearest);
        apart <= 0 ? search(begin, middle, point, nearest)
                   : search(middle + 1, end, point, nearest);
        if (apart * apart < nearest.worst()) {
            apart <= 0 ? search(middle + 1, end, point, nearest)
                       : search(begin, middle, point, nearest);
        }
    }

    const std::vector<glm::dvec3>& points_;
    std::vector<std::uint32_t> order_;
    std::vector<unsigned char> axes_; ///< of the middles
};

} // namespace

std::vector<double> mean_squared_distances(const std::vector<glm::dvec3>& points) {
    const PointTree tree(points);
    std::vector<double> means(points.size());
    parallel_ranges(points.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            means[i] = tree.mean_squared(static_cast<std::uint32_t>(i));
        }
    });
    return means;
}

} // namespace degs
