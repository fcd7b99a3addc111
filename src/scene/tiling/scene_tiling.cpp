// SPDX-License-Identifier: Apache-2.0
#include "scene/tiling/scene_tiling.hpp"

#include <algorithm>
#include <cmath>

#include "degs/error.hpp"
#include "scene/cameras/orbit_camera.hpp"
#include "scene/scene_statistics.hpp"
#include "splat/model/angles.hpp"

namespace degs {
namespace {

constexpr double kGap = 1.05;
constexpr int kViewWidth = 1920, kViewHeight = 1080;
constexpr double kViewDegrees = 60; ///< horizontal field of view

[[noreturn]] void refuse_copies(const std::string& what) {
    throw InputError(what + " needs more than " + std::to_string(TilingCounts::kMostCopies) +
                     " copies, which is the most that a tiled scene may have.");
}

/// 0 unless `text` is a number of 1 to 5 digits.
int small_number(const std::string& text) {
    const bool digits = !text.empty() && text.size() <= 5 &&
                        text.find_first_not_of("0123456789") == std::string::npos;
    return digits ? std::stoi(text) : 0;
}

/// Percentiles 1 and 99 of the means.
struct Extent {
    glm::dvec3 middle, size;
};

Extent extent_of(const GaussianCloud& cloud) {
    const SceneStatistics statistics = measure_scene(cloud);
    const glm::dvec3 size = statistics.high - statistics.low;
    return {(statistics.low + statistics.high) / 2.0, size};
}

/// Scenes may be flat, and a single Gaussian has no extent.
glm::dvec3 spacing_of(const glm::dvec3& size) {
    const double side = kGap * std::max(size.x, size.z);
    const double height = kGap * size.y;
    return {side > 0 ? side : 1, height > 0 ? height : 1, side > 0 ? side : 1};
}

/// Quarter turns about y keep the extent inside its square.
GlbInstance placed_copy(const glm::dvec3& middle, const glm::dvec3& offset, int quarter_turns) {
    const double half = quarter_turns * kPi / 4;
    const double s = std::sin(2 * half);
    const double c = std::cos(2 * half);
    const glm::dvec3 turned(c * middle.x + s * middle.z, middle.y, c * middle.z - s * middle.x);
    GlbInstance instance;
    instance.translation = middle + offset - turned;
    instance.rotation = {0, std::sin(half), 0, std::cos(half)};
    return instance;
}

Camera view(const char* name, int id, const glm::dvec3& from, const glm::dvec3& to) {
    Camera camera = looking_at(from, to);
    camera.name = name;
    camera.id = id;
    camera.width = kViewWidth;
    camera.height = kViewHeight;
    camera.fx = kViewWidth / (2 * std::tan(kViewDegrees * kDegree / 2));
    camera.fy = camera.fx;
    return camera;
}

/// `half` is half of the grid's size.
std::vector<Camera> views_of(const Extent& extent, const glm::dvec3& half) {
    const double radius = std::hypot(half.x, half.z) + half.y;
    const glm::dvec3& middle = extent.middle;
    const glm::dvec3 above(0, -(half.y + extent.size.y * 0.25), 0);
    return {
        view("overview", 0, middle + radius * glm::dvec3(0.84, -1.18, -1.52), middle),
        view("near", 1, middle + glm::dvec3(0.3 * half.x, 0, -1.1 * half.z) + above * 1.5, middle),
        view("closeup", 2, middle + glm::dvec3(-0.8 * half.x, 0, -0.8 * half.z) + above,
             middle + glm::dvec3(half.x, 0, half.z)),
    };
}

} // namespace

TilingCounts parse_tiling(const std::string& text) {
    std::vector<int> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('x', begin), text.size());
        numbers.push_back(small_number(text.substr(begin, end - begin)));
        begin = end + 1;
    }
    if (numbers.size() < 2 || numbers.size() > 3 ||
        *std::min_element(numbers.begin(), numbers.end()) < 1) {
        throw InputError("The copies '" + text +
                         "' are not written as in 4x3 (along x and z) or 4x3x2 (and two layers), "
                         "with numbers from 1.");
    }
    TilingCounts counts{numbers[0], numbers.size() == 3 ? numbers[2] : 1, numbers[1], 0};
    counts.copies = std::uint64_t{1} * counts.x * counts.y * counts.z;
    if (counts.copies > TilingCounts::kMostCopies) {
        refuse_copies("A grid of " + text);
    }
    return counts;
}

TilingCounts tiling_for(std::uint64_t wanted, std::uint64_t gaussians) {
    const std::uint64_t copies =
        std::max<std::uint64_t>(wanted / gaussians + (wanted % gaussians != 0), 1);
    if (copies > TilingCounts::kMostCopies) {
        refuse_copies("A scene of " + std::to_string(wanted) + " Gaussians from one of " +
                      std::to_string(gaussians));
    }
    TilingCounts counts;
    counts.copies = copies;
    counts.x = static_cast<int>(std::ceil(std::sqrt(copies)));
    counts.z = static_cast<int>((copies + counts.x - 1) / counts.x);
    return counts;
}

SceneTiling tile_scene(const GaussianCloud& cloud, const TilingCounts& counts) {
    const Extent extent = extent_of(cloud);
    SceneTiling tiling;
    tiling.spacing = spacing_of(extent.size);
    const glm::dvec3 last(counts.x - 1, counts.y - 1, counts.z - 1);
    for (int y = 0; y < counts.y; ++y) {
        for (int z = 0; z < counts.z; ++z) {
            for (int x = 0; x < counts.x && tiling.instances.size() < counts.copies; ++x) {
                const glm::dvec3 offset = (glm::dvec3(x, y, z) - last / 2.0) * tiling.spacing;
                tiling.instances.push_back(
                    placed_copy(extent.middle, offset, (x + 2 * z + 3 * y) % 4));
                tiling.instances.back().name =
                    "copy " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z);
            }
        }
    }
    tiling.cameras =
        views_of(extent, glm::dvec3(counts.x, counts.y, counts.z) * tiling.spacing / 2.0);
    return tiling;
}

} // namespace degs
