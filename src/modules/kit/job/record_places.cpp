// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/job/record_places.hpp"

#include <algorithm>
#include <numeric>

namespace degs {
namespace {

constexpr unsigned kAxisBits = 21;

/// Puts two zeros between the bits of `value`, which has kAxisBits.
std::uint64_t spread_bits(std::uint64_t value) {
    std::uint64_t spread = 0;
    for (unsigned bit = 0; bit < kAxisBits; ++bit) {
        spread |= (value >> bit & 1U) << 3 * bit;
    }
    return spread;
}

std::vector<std::uint64_t> morton_codes(const std::vector<glm::vec3>& positions) {
    glm::dvec3 low(positions.front());
    glm::dvec3 high = low;
    for (const glm::vec3& position : positions) {
        low = glm::min(low, glm::dvec3(position));
        high = glm::max(high, glm::dvec3(position));
    }
    const double side = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    const double cells = (1U << kAxisBits) - 1;
    const double scale = side > 0 ? cells / side : 0;
    std::vector<std::uint64_t> codes;
    codes.reserve(positions.size());
    for (const glm::vec3& position : positions) {
        const glm::dvec3 cell = (glm::dvec3(position) - low) * scale;
        std::uint64_t code = 0;
        for (int axis = 0; axis < 3; ++axis) {
            code |= spread_bits(static_cast<std::uint64_t>(cell[axis])) << axis;
        }
        codes.push_back(code);
    }
    return codes;
}

} // namespace

std::vector<std::uint32_t> morton_ranks(const std::vector<glm::vec3>& positions) {
    if (positions.empty()) {
        return {};
    }
    const std::vector<std::uint64_t> codes = morton_codes(positions);
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return codes[a] < codes[b]; });
    std::vector<std::uint32_t> ranks(order.size());
    for (std::uint32_t place = 0; place < order.size(); ++place) {
        ranks[order[place]] = place;
    }
    return ranks;
}

RecordPlaces::RecordPlaces(const FrameWorkload& frame, RecordOrder order)
    : of_visible_(order == RecordOrder::Morton ? morton_ranks(frame.visible_means)
                                               : std::vector<std::uint32_t>()) {
    if (frame.visible_of.empty()) {
        return;
    }
    const std::uint32_t first =
        frame.visible_of.front(); // culled Gaussians before it need no entry
    std::vector<std::uint32_t> place(frame.visible_of.back() - first + std::size_t{1}, 0);
    for (std::uint32_t rank = 0; rank < frame.visible_of.size(); ++rank) {
        place[frame.visible_of[rank] - first] = of_visible_.empty() ? rank : of_visible_[rank];
    }
    of_splats_.reserve(frame.splats.size());
    for (const ProjectedSplat& splat : frame.splats) {
        of_splats_.push_back(place[splat.id - first]);
    }
}

} // namespace degs
